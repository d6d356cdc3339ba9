// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace cca {

/// Notices that the robot gets nowhere: it neither leaves a place nor walks on along a boundary, or
/// walks for half a minute and has not left. Before a gap of its own width a robot may turn to one
/// post and then the other, and take that for a walk.
class ProgressWatch {
 public:
  /// Another boundary is followed, or the same one the other way: its length begins at zero, and it
  /// has the whole patience.
  void startWalk(double time);

  /// @param x_map   m, the robot. @param length  m, walked along the boundary so far.
  /// @param excused whether the robot waits for somebody: that time does not count.
  /// @return        true where there has been no progress for kPatience; then it starts anew.
  bool stuck(const Eigen::Vector2d& x_map, double length, double time, bool excused);

  static constexpr double kPatience = 6.0;  ///< s; a whole turn on the spot takes 4.5 s

 private:
  void arriveAt(const Eigen::Vector2d& x_map, double time);

  std::optional<Eigen::Vector2d> x_map_, place_map_;  ///< m, when it last got on; came here
  double length_ = 0.0, since_ = 0.0;                 ///< m, s, when it last got on
  double arrived_ = 0.0;                              ///< s, when it came here
};

}  // namespace cca
