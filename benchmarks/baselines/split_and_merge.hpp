// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct SplitAndMergeParameters {
  CommonParameters common;
  double tolerance = 0.05;  ///< m
  static SplitAndMergeParameters tuned();
};

template <class Field>
void describe(SplitAndMergeParameters& p, Field&& field) {
  describe(p.common, field);
  field("tolerance", p.tolerance, 0.005, 0.5, "m", "two neighbours farther away split a line");
}

/// Split-and-Merge [Pavlidis & Horowitz 1974; Nguyen et al. 2007, Algorithm 1].
///
/// A run is split while two neighbouring points, on the same side, lie beyond the tolerance from
/// its fitted line (a single one is taken for noise); then collinear neighbours are merged.
/// Deviation: the split falls on the point farthest from the chord of the run's ends; the point
/// farthest from the fitted line is often an end of the run, and would be cut off alone.
/// @return  segments in the sensor frame, by bearing. Cost: O(n log n), O(n^2) at worst.
std::vector<LineSegment> splitAndMerge(const Scan& scan, const SplitAndMergeParameters& p = {});

}  // namespace cca::baselines
