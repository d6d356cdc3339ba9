// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct LineRegressionParameters {
  CommonParameters common;
  int window = 7;                 ///< points
  double range_noise = 0.03;      ///< m
  double largest_fidelity = 6.0;  ///< squared Mahalanobis distance
  double merge_distance = 9.0;    ///< squared Mahalanobis distance
  static LineRegressionParameters tuned();
};

template <class Field>
void describe(LineRegressionParameters& p, Field&& field) {
  describe(p.common, field);
  field("window", p.window, 3, 15, "points", "points of the sliding window");
  field("range_noise", p.range_noise, 0.003, 0.1, "m", "standard deviation of a range");
  field("largest_fidelity", p.largest_fidelity, 0.5, 50.0, "",
        "squared Mahalanobis distance of neighbouring windows on one line");
  field("merge_distance", p.merge_distance, 0.5, 50.0, "",
        "squared Mahalanobis distance of neighbouring segments on one line");
}

/// Line Regression [Arras & Siegwart 1997; Nguyen et al. 2007, Algorithm 4].
///
/// A line is fitted to each window of neighbouring points; where three consecutive windows agree in
/// the line's parameters (Mahalanobis), their points belong together; then neighbouring segments
/// whose parameters agree are joined, nearest pair first (agglomerative).
/// @return  segments in the sensor frame, by bearing. Cost: O(n window + m^2), m segments.
std::vector<LineSegment> lineRegression(const Scan& scan, const LineRegressionParameters& p = {});

}  // namespace cca::baselines
