// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/progress_watch.hpp"

namespace cca {
namespace {
constexpr double kMoved = 0.5;    // m
constexpr double kWalked = 0.2;   // m
constexpr double kAround = 30.0;  // s, longer than it takes to walk around anything within kMoved
}  // namespace

void ProgressWatch::startWalk(double time) {
  length_ = 0.0;
  since_ = time;
}

bool ProgressWatch::stuck(const Eigen::Vector2d& x_map, double length, double time, bool excused) {
  if (excused || !place_map_ || (x_map - *place_map_).norm() > kMoved) arriveAt(x_map, time);
  const bool moved = !x_map_ || (x_map - *x_map_).norm() > kMoved;
  const bool stuck = !moved && (time - since_ > kPatience || time - arrived_ > kAround);
  if (moved || stuck || excused || length - length_ > kWalked) {
    x_map_ = x_map;
    length_ = length;
    since_ = time;
  }
  if (stuck) arriveAt(x_map, time);
  return stuck && !excused;
}

void ProgressWatch::arriveAt(const Eigen::Vector2d& x_map, double time) {
  place_map_ = x_map;
  arrived_ = time;
}

}  // namespace cca
