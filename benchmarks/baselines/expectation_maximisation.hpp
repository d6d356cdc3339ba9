// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/inliers.hpp"

namespace cca::baselines {

struct ExpectationMaximisationParameters {
  InlierParameters inliers;
  double noise = 0.03;  ///< m
  int trials = 50;
  int iterations = 200;
  std::uint64_t seed = 1;
  static ExpectationMaximisationParameters tuned();
};

template <class Field>
void describe(ExpectationMaximisationParameters& p, Field&& field) {
  describe(p.inliers, field);
  field("noise", p.noise, 0.003, 0.2, "m", "standard deviation of a point about its line");
  field("trials", p.trials, 5, 50, "", "random starts for a line");
  field("iterations", p.iterations, 5, 200, "", "most E and M steps from a start");
}

/// Expectation-Maximisation [Pfister; Nguyen et al. 2007, Algorithm 7].
///
/// From a random line: each point's weight is the Gaussian likelihood of its distance (E), the line
/// is refitted with these weights (M), until it stands. The best-supported of all starts is
/// gathered, refitted, cut at gaps and taken out; until none has enough points.
/// Deviation: a start is a line through two neighbouring remaining points a few beams apart;
/// a line drawn at random in the plane seldom meets any wall.
/// @return  segments in the sensor frame, by bearing; the same for the same seed.
///          Cost: O(n trials iterations) per line.
std::vector<LineSegment> expectationMaximisation(const Scan& scan,
                                                 const ExpectationMaximisationParameters& p = {});

}  // namespace cca::baselines
