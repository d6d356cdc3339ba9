// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct KalmanGroupingParameters {
  SegmentLimits limits;
  double range_noise = 0.02;    ///< m
  double gate = 9.0;            ///< squared standard deviations
  double tolerance = 0.06;      ///< m
  double largest_radius = 1.0;  ///< m
  static KalmanGroupingParameters tuned();
};

template <class Field>
void describe(KalmanGroupingParameters& p, Field&& field) {
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
  field("range_noise", p.range_noise, 0.002, 0.2, "m", "standard deviation of a range");
  field("gate", p.gate, 1.0, 100.0, "", "squared standard deviations that end a group");
  field("tolerance", p.tolerance, 0.005, 0.5, "m", "points farther away split a group of edges");
  field("largest_radius", p.largest_radius, 0.1, 5.0, "m", "of a circle; others are edges");
}

/// Groups by an extended Kalman filter, in each of which an edge or a circle is fitted: after what
/// is told of the paper's [12], and of the same authors' work [Zhang, Xie & Adams 2003 to 2005].
///
/// Along a plane the inverse range u follows u(k+1) = 2 cos(spacing) u(k) - u(k-1): the filter's
/// state is two of them, and a return outside of the gate begins another group. A reconstruction,
/// the text was not at hand: the gate, and that a group of several edges is split at its corners,
/// are ours; circles are fitted algebraically instead of by Gauss-Newton. They are told apart, and
/// not returned.
/// @return  segments in the sensor frame, by bearing. Cost: O(n log n), O(n^2) at worst.
std::vector<LineSegment> kalmanGrouping(const Scan& scan, const KalmanGroupingParameters& p = {});

}  // namespace cca::baselines
