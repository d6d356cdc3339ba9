// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace cca {

/// Notices that the robot gets nowhere: it neither leaves a place nor walks on along a boundary.
class ProgressWatch {
 public:
  /// @param x_map   m, the robot. @param length  m, walked along the boundary so far.
  /// @param excused whether the robot waits for somebody: that time does not count.
  /// @return        true where there has been no progress for kPatience; then it starts anew.
  bool stuck(const Eigen::Vector2d& x_map, double length, double time, bool excused);

  static constexpr double kPatience = 6.0;  ///< s; a whole turn on the spot takes 4.5 s

 private:
  std::optional<Eigen::Vector2d> x_map_;
  double length_ = 0.0, since_ = 0.0;
};

}  // namespace cca
