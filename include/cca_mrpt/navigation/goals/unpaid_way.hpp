// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace cca {

/// The way that a robot has driven beyond what the places that it saw meanwhile were worth.
///
/// It grows by each metre, and falls by the worth of all that is newly seen, to zero at the least:
/// what was earned long ago pays for nothing now. However promising the places look that are left,
/// where much way is unpaid the next ones will not show what they promise either.
class UnpaidWay {
 public:
  /// @param worth  m of way that a newly seen square metre is worth, >= 0.
  explicit UnpaidWay(double worth) : worth_(worth) {}

  /// Takes where the robot is (m, map frame, finite), and the area seen so far (m^2). Where that
  /// has become less, the place was made anew: nothing new was seen.
  void note(const Eigen::Vector2d& robot_map, double seen);

  double metres() const { return metres_; }

 private:
  double worth_, metres_ = 0.0, seen_ = 0.0;
  std::optional<Eigen::Vector2d> last_place_;
};

}  // namespace cca
