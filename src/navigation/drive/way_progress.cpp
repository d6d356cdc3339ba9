// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/way_progress.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/navigation/place/grid_paths.hpp"

namespace cca {
namespace {

constexpr double kShorter = 0.02;    // m: less is noise
constexpr double kAnotherWay = 0.5;  // m longer, from one step to the next
constexpr double kPatience = 10.0;   // s, and a whole turn
constexpr double kSlowest = 0.2;     // of full speed
constexpr double kGrace = 30.0;      // s

}  // namespace

void WayProgress::note(int goal, const std::vector<Eigen::Vector2d>& way, double time) {
  if (way.empty()) return;
  const double left = pathLength(way);
  const bool is_another_goal = goal != goal_;
  if (is_another_goal) {
    goal_ = goal;
    deadline_ = time + kGrace + left / (kSlowest * robot_.max_linear_velocity);
  }
  if (is_another_goal || left < least_ - kShorter || left > last_ + kAnotherWay) {
    shortest_ = way;
    least_ = left;
    since_ = time;
  }
  last_ = left;
}

void WayProgress::excuse(double time) {
  since_ = time;
  deadline_ = std::max(deadline_, time + kGrace);
}

bool WayProgress::isStuck(double time) {
  if (time - since_ <= kPatience + 2.0 * M_PI / robot_.max_angular_velocity) return false;
  since_ = time;
  return true;
}

}  // namespace cca
