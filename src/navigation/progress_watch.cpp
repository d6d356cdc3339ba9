// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/progress_watch.hpp"

namespace cca {
namespace {
constexpr double kMoved = 0.5;   // m
constexpr double kWalked = 0.2;  // m
}  // namespace

bool ProgressWatch::stuck(const Eigen::Vector2d& x_map, double length, double time, bool excused) {
  const bool moved = !x_map_ || (x_map - *x_map_).norm() > kMoved;
  const bool stuck = !moved && time - since_ > kPatience;
  if (moved || stuck || excused || length - length_ > kWalked) {
    x_map_ = x_map;
    length_ = length;
    since_ = time;
  }
  return stuck && !excused;
}

}  // namespace cca
