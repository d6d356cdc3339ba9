// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// What bumpers, cliff sensors and the like have met: they see a place only while the robot is
/// beside it, and it must not be driven into when it is out of their sight again.
class HazardMemory {
 public:
  /// Takes points; one within the same 5 cm replaces the earlier one, and is as young as the last.
  /// @param points  m, a frame that the robot drives smoothly in; what is not finite is passed
  ///                over. @param time  s. Cost: O(points log kept).
  void add(const std::vector<Eigen::Vector2d>& points, double time);

  /// Forgets what is older than kAge, which odometry bears, or farther than kReach.
  /// @return what is left, in no order of meaning. Cost: O(kept).
  std::vector<Eigen::Vector2d> around(const Eigen::Vector2d& robot, double time);

  /// Takes all along to where it is now. @param T_now_was  of the frame.
  void move(const Pose2& T_now_was);

  static constexpr double kAge = 60.0;   ///< s; odometry is off by centimetres after it
  static constexpr double kReach = 6.0;  ///< m, what a robot drives in ten seconds

 private:
  struct Point {
    Eigen::Vector2d p;
    double time;
  };
  std::map<std::pair<int, int>, Point> points_;  ///< by square
};

}  // namespace cca
