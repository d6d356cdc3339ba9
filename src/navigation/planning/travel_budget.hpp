// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace cca {

/// The way that a robot has driven beyond what the places that it saw meanwhile were worth: it
/// grows by each metre, and falls by the worth of all that is newly seen, to zero at the least.
/// Where much is unpaid, what is left will not show what it promises either.
class TravelBudget {
 public:
  /// @param worth  m of way that a newly seen square metre is worth, >= 0.
  explicit TravelBudget(double worth) : worth_(worth) {}

  /// Takes where the robot is (m, map frame, finite), and the area seen so far (m^2). Where that
  /// has become less, the world was made anew: nothing new was seen.
  void note(const Eigen::Vector2d& robot_map, double seen);

  double unpaid() const { return unpaid_; }  ///< m

 private:
  double worth_, unpaid_ = 0.0, seen_ = 0.0;
  std::optional<Eigen::Vector2d> last_place_;
};

}  // namespace cca
