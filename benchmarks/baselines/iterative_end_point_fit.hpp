// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct IterativeEndPointFitParameters {
  CommonParameters common;
  double tolerance = 0.1;  ///< m
  static IterativeEndPointFitParameters tuned();
};

template <class Field>
void describe(IterativeEndPointFitParameters& p, Field&& field) {
  describe(p.common, field);
  field("tolerance", p.tolerance, 0.005, 0.5, "m", "distance from the chord that splits a run");
}

/// Iterative End-Point Fit [Duda & Hart 1973; Borges & Aldon 2004].
///
/// A run is split at the point farthest from the chord between its ends, while that is beyond the
/// tolerance. The segments are the chords: no least squares, which is what sets it apart from
/// Split-and-Merge.
/// @return  segments in the sensor frame, by bearing. Cost: O(n log n), O(n^2) at worst.
std::vector<LineSegment> iterativeEndPointFit(const Scan& scan,
                                              const IterativeEndPointFitParameters& p = {});

}  // namespace cca::baselines
