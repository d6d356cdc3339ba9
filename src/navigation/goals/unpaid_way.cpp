// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/unpaid_way.hpp"

#include <algorithm>

namespace cca {

void UnpaidWay::note(const Eigen::Vector2d& robot_map, double seen) {
  const double way = last_place_ ? (robot_map - *last_place_).norm() : 0.0;
  metres_ = std::max(0.0, metres_ + way - worth_ * std::max(0.0, seen - seen_));
  last_place_ = robot_map;
  seen_ = seen;
}

}  // namespace cca
