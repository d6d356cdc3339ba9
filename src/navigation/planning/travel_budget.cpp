// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/travel_budget.hpp"

#include <algorithm>

namespace cca {

void TravelBudget::note(const Eigen::Vector2d& robot_map, double seen) {
  const double way = last_place_ ? (robot_map - *last_place_).norm() : 0.0;
  unpaid_ = std::max(0.0, unpaid_ + way - worth_ * std::max(0.0, seen - seen_));
  last_place_ = robot_map;
  seen_ = seen;
}

}  // namespace cca
