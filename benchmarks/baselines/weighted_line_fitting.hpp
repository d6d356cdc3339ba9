// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/hough_accumulator.hpp"
#include "baselines/inliers.hpp"

namespace cca::baselines {

struct WeightedLineFittingParameters {
  HoughResolution grouping{2.0, 0.05};
  InlierParameters inliers{0.1, 0.3, {}};
  double range_noise = 0.03;       ///< m
  double bearing_noise_deg = 0.2;  ///< deg
  double chi_square = 11.8;        ///< two degrees of freedom, three sigma
  static WeightedLineFittingParameters tuned();
};

template <class Field>
void describe(WeightedLineFittingParameters& p, Field&& field) {
  describe(p.grouping, field);
  describe(p.inliers, field);
  field("range_noise", p.range_noise, 0.003, 0.1, "m", "standard deviation of a range");
  field("bearing_noise_deg", p.bearing_noise_deg, 0.01, 1.0, "deg",
        "standard deviation of a bearing");
  field("chi_square", p.chi_square, 2.0, 30.0, "", "segments below this distance are one line");
}

/// Weighted line fitting for segments with chi-square merging [Pfister, Roumeliotis & Burdick
/// 2003].
///
/// The Hough transform groups the points; each line is fitted with the inverse variance of each
/// point across the line (range and bearing noise) as weight, iterated as the variance depends on
/// the line; segments whose (offset, orientation) agree within the chi-square bound and that touch
/// are merged, weighted by their covariances.
/// @return  segments in the sensor frame, by bearing. Cost: O(cells) per line.
std::vector<LineSegment> weightedLineFitting(const Scan& scan,
                                             const WeightedLineFittingParameters& p = {});

}  // namespace cca::baselines
