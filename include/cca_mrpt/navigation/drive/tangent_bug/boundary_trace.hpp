// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "cca_mrpt/navigation/drive/tangent_bug/configuration_space.hpp"

namespace cca {

/// A place on the boundary of the configuration space.
struct BoundaryPoint {
  Eigen::Vector2d center_map;  ///< m, of the robot touching the obstacle
  int obstacle = 0;            ///< that it touches
  double length = 0.0;         ///< m, along the boundary from the trace's start
  double heading = 0.0;        ///< rad, of the motion, unwrapped along the trace
};

/// Rolls the robot's disc along the obstacle points, from the place nearest to `start_map`.
///
/// The disc turns around the point that it touches until it touches another one, and so on: an
/// exact walk along the union of discs, whatever order or spacing the points have. Headings count
/// whole turns: +2 pi for a closed loop walked counter-clockwise.
///
/// @param on_the_right  the obstacle lies on the right of the motion.
/// @param longest       m. @param goes_on  asked at each new place; false ends the trace before it.
/// @return  points at most 20 degrees of arc apart; empty where there is no obstacle.
/// Cost: O(touched points * obstacles).
std::vector<BoundaryPoint> traceBoundary(
    const ConfigurationSpace& space, const Eigen::Vector2d& start_map, bool on_the_right,
    double longest, const std::function<bool(const Eigen::Vector2d&)>& goes_on);

}  // namespace cca
