// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct IncrementalParameters {
  CommonParameters common;
  double tolerance = 0.05;  ///< m
  double max_rms = 0.03;    ///< m
  static IncrementalParameters tuned();
};

template <class Field>
void describe(IncrementalParameters& p, Field&& field) {
  describe(p.common, field);
  field("tolerance", p.tolerance, 0.005, 0.5, "m", "distance at which a new point ends the line");
  field("max_rms", p.max_rms, 0.003, 0.3, "m", "largest root mean square residual of a line");
}

/// Incremental, or line tracking [Forsyth & Ponce 2003; Nguyen et al. 2007, Algorithm 3].
///
/// Points join the current line one after the other while the refitted line stays good; then a new
/// line begins. Collinear neighbours are merged at the end.
/// @return  segments in the sensor frame, by bearing. Cost: O(n).
std::vector<LineSegment> incremental(const Scan& scan, const IncrementalParameters& p = {});

}  // namespace cca::baselines
