// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/inliers.hpp"

namespace cca::baselines {

struct RansacParameters {
  InlierParameters inliers;
  int trials = 1000;
  std::uint64_t seed = 1;
  static RansacParameters tuned();
};

template <class Field>
void describe(RansacParameters& p, Field&& field) {
  describe(p.inliers, field);
  field("trials", p.trials, 50, 1000, "", "pairs of points that are tried for a line");
}

/// Random Sample Consensus [Fischler & Bolles 1981; Nguyen et al. 2007, Algorithm 5].
///
/// Of the lines through pairs of remaining points drawn at random, the one with most points near it
/// is refitted, cut at gaps and taken out; until no line has enough points.
/// @return  segments in the sensor frame, by bearing; the same for the same seed.
///          Cost: O(n trials) per line.
std::vector<LineSegment> ransac(const Scan& scan, const RansacParameters& p = {});

}  // namespace cca::baselines
