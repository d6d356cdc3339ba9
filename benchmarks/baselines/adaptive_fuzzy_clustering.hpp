// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct AdaptiveFuzzyClusteringParameters {
  SegmentLimits limits;
  double cell = 1.0;        ///< m
  double noise = 0.1;       ///< m
  double thickness = 0.03;  ///< m
  double max_gap = 0.3;     ///< m
  static AdaptiveFuzzyClusteringParameters tuned();
};

template <class Field>
void describe(AdaptiveFuzzyClusteringParameters& p, Field&& field) {
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
  field("cell", p.cell, 0.2, 4.0, "m", "side of a square of the workspace");
  field("noise", p.noise, 0.02, 0.5, "m", "distance at which a point is as likely to be noise");
  field("thickness", p.thickness, 0.003, 0.2, "m", "root mean square distance within one segment");
  field("max_gap", p.max_gap, 0.05, 2.0, "m", "largest gap between segments that are merged");
}

/// Enhanced adaptive fuzzy clustering with noise clustering, the paper's [14] [Ip, Rad, Chow & Wong
/// 2002], which was made for ultrasonic sensors.
///
/// Points are dealt out to square cells. In each of them they are clustered around one line, or two
/// where one is too thick: memberships 1 / sum (d_i / d_k)^2 over the lines and a noise cluster
/// that is equally far from all points [Dave 1991], lines from the scatter weighted by their
/// squares. Segments merge where the smaller eigenvalue of their common scatter stays small. A
/// reconstruction, its text was not at hand: beginnings, thresholds and the gap are ours.
/// @return  segments in the sensor frame, by bearing of their centroids. Cost: O(n) a round, and
///          O(s^3) for s segments.
std::vector<LineSegment> adaptiveFuzzyClustering(const Scan& scan,
                                                 const AdaptiveFuzzyClusteringParameters& p = {});

}  // namespace cca::baselines
