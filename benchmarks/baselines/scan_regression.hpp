// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct ScanRegressionParameters {
  CommonParameters common;
  double range_noise = 0.02;  ///< m
  double price = 40.0;        ///< in units of the noise's variance
  static ScanRegressionParameters tuned();
};

template <class Field>
void describe(ScanRegressionParameters& p, Field&& field) {
  describe(p.common, field);
  field("range_noise", p.range_noise, 0.002, 0.2, "m", "standard deviation of a range");
  field("price", p.price, 3.0, 300.0, "", "what a line more must save, in noise variances");
}

/// Segmentation of whole scans by regression, after what is told of the paper's [8]: it "does not
/// treat single range readings", but works on "whole scans".
///
/// A reconstruction, its text was not at hand: of all ways to cut a run of points into lines, the
/// one of least sum of squared residuals, plus a price for each line, by dynamic programming.
/// @return  segments in the sensor frame, by bearing. Cost: O(n^2) for a run of n points.
std::vector<LineSegment> scanRegression(const Scan& scan, const ScanRegressionParameters& p = {});

}  // namespace cca::baselines
