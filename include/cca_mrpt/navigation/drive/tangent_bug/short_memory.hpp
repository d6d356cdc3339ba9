// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/navigation/drive/local_view.hpp"

namespace cca {

/// What a laser of less than 360 degrees has just seen and sees no longer, because the robot turned
/// or drove on: obstacles beside and behind it.
class ShortMemory {
 public:
  /// Takes over what left the field of view between the two, forgets what is in it again, is
  /// farther than kReach or older than kAge.
  void update(const LocalView& before, const LocalView& now, double time);

  void forget() { points_.clear(); }
  std::vector<Eigen::Vector2d> points() const;  ///< m, map frame

  static constexpr double kReach = 4.0;  ///< m
  static constexpr double kAge = 20.0;   ///< s

 private:
  struct Point {
    Eigen::Vector2d p_map;
    double time;
  };
  std::vector<Point> points_;
};

}  // namespace cca
