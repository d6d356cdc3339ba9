// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct ExtendedSplitAndMergeParameters {
  CommonParameters common;
  double edge = 0.3;        ///< m
  double tracking = 0.06;   ///< m
  double tolerance = 0.05;  ///< m
  static ExtendedSplitAndMergeParameters tuned();
};

template <class Field>
void describe(ExtendedSplitAndMergeParameters& p, Field&& field) {
  describe(p.common, field);
  field("edge", p.edge, 0.05, 2.0, "m", "ranges that differ by more label a break point");
  field("tracking", p.tracking, 0.01, 0.5, "m", "a point farther from the line so far ends it");
  field("tolerance", p.tolerance, 0.005, 0.5, "m", "points farther away split a line");
}

/// The extended Split-and-Merge of the paper's [13], after what is told of it: potential break
/// points are labelled first; then "two threshold-based line extraction and one Split-and-Merge
/// kernels" are gone through.
///
/// A reconstruction, its text was not at hand: the two thresholds are those of Successive Edge
/// Following (neighbouring ranges) and Line Tracking (distance from the line so far) [Siadat et al.
/// 1997]; a labelled break is an end for good only where the gap is one by the adaptive rule.
/// @return  segments in the sensor frame, by bearing. Cost: O(n log n), O(n^2) at worst.
std::vector<LineSegment> extendedSplitAndMerge(const Scan& scan,
                                               const ExtendedSplitAndMergeParameters& p = {});

}  // namespace cca::baselines
