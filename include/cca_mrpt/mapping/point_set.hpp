// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// A laser return in any frame, which knows what it is worth.
struct SpatialPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double sigma = 0.0;    ///< m, > 0, deviation of its distance from the wall that it saw
  double spacing = 0.0;  ///< m, > 0, to the next return on a wall seen head on: r dphi
};

/// Appends the returns of a scan, taken to another frame.
void appendPoints(const Scan& scan, const Pose2& T_frame_sensor, std::vector<SpatialPoint>* points);

/// The lines of points in no order, as of several scans in one frame: the steps of
/// extractLines(const Scan&), by K-means and 2-means in the plane, SIM, ROC, merge and repeat.
///
/// What only a scan has is replaced: a gap is judged by the spacing of the points, not by the rays
/// that crossed it; and, seen from several places, a wall may have two layers of points side by
/// side, which the fifth membership keeps apart where they are two faces. Corners are re-assigned
/// to the nearer line, and neighbours whose ends meet there share the vertex.
///
/// @param points  any order, which does not matter but for ties; not finite ones are left out.
/// @return        as for a scan, in the points' frame, ordered by start; without viewpoint, start
///                precedes end in x, then y.
/// Cost: O(N sqrt(K)) to cluster, O(n^2) for n segments a round.
std::vector<LineSegment> extractLines(const std::vector<SpatialPoint>& points,
                                      const CcaParameters& parameters = {});

}  // namespace cca
