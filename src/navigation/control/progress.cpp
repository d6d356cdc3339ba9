// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/progress.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "navigation/world/grid_paths.hpp"

namespace cca {
namespace {

constexpr double kShorter = 0.02;  // m: less is noise of the pose, not way
constexpr double kSlowest = 0.2;   // of full speed: who is slower on the whole way is stuck
constexpr double kGrace = 30.0;    // s, for turns, people and narrow places on any way

// m, clearly elsewhere. Who goes less within kPatience, any way, stands; a way that is longer by
// more from one step to the next is another one.
constexpr double kMoved = 0.5;
constexpr double kWalked = 0.2;  // m, along a boundary, which may wind back

}  // namespace

void PathProgress::note(int goal, const std::vector<Eigen::Vector2d>& way, double time,
                        const RobotParameters& robot, bool looks_around) {
  time_ = time;
  if (way.empty()) return;
  const double left = pathLength(way);
  const bool is_another_goal = goal != goal_;
  if (is_another_goal) {
    goal_ = goal;
    const double turn = 2.0 * M_PI / (kLookAround * robot.max_angular_velocity);
    const double more = looks_around ? turn : 0.0;
    deadline_ = time + kGrace + more + left / (kSlowest * robot.max_linear_velocity);
  }
  const bool was_corrected = std::exchange(is_corrected_, false);
  const bool has_changed = left < least_ - kShorter || left > last_ + kMoved;
  const bool gets_on = is_another_goal || (has_changed && !was_corrected);
  if (gets_on) clock_.restart(time);
  if (gets_on || was_corrected) {
    shortest_ = way;
    least_ = left;
  }
  last_ = left;
}

void PathProgress::pauseTimers(double time) {
  clock_.restart(time);
  deadline_ += std::max(0.0, time - time_);
  time_ = time;
}

bool PathProgress::isStuck(double time, const RobotParameters& robot) {
  const bool is_over = clock_.isOver(kPatience + 2.0 * M_PI / robot.max_angular_velocity, time);
  if (is_over) clock_.restart(time);
  return is_over;
}

void WalkProgress::startWalk(double time) {
  length_ = 0.0;
  clock_.restart(time);
}

bool WalkProgress::isStuck(const Eigen::Vector2d& x_map, double length, double time, bool excused) {
  const bool has_moved = !x_map_ || (x_map - *x_map_).norm() > kMoved;
  const bool is_stuck = !has_moved && clock_.isOver(kPatience, time);
  if (has_moved || is_stuck || excused || length - length_ > kWalked) {
    x_map_ = x_map;
    length_ = length;
    clock_.restart(time);
  }
  return is_stuck && !excused;
}

}  // namespace cca
