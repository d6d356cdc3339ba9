// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct PredictedFeaturesParameters {
  SegmentLimits limits;
  int seed_points = 5;
  double seed_rms = 0.03;       ///< m
  double prediction = 0.15;     ///< m
  double largest_radius = 1.0;  ///< m
  static PredictedFeaturesParameters tuned();
};

template <class Field>
void describe(PredictedFeaturesParameters& p, Field&& field) {
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
  field("seed_points", p.seed_points, 3, 15, "points", "that a feature begins with");
  field("seed_rms", p.seed_rms, 0.003, 0.3, "m", "root mean square of their distances from it");
  field("prediction", p.prediction, 0.01, 1.0, "m",
        "farther from where the feature meets the beam, a return is the next one's");
  field("largest_radius", p.largest_radius, 0.1, 5.0, "m", "of a circle; others are lines");
}

/// Prediction-based feature extraction [Zhao & Chen 2011]: lines and circles in one pass, without a
/// segmentation before. The feature so far predicts the range of the next beam; the return belongs
/// to it if it lies there, else another feature begins.
///
/// A reconstruction from the abstract: seeds, thresholds and the choice between line and circle
/// (the smaller residual, see isRound()) are ours. Circles are told apart, and not returned.
/// @return  segments in the sensor frame, by bearing. Cost: O(n) and a fit for each point.
std::vector<LineSegment> predictedFeatures(const Scan& scan,
                                           const PredictedFeaturesParameters& p = {});

}  // namespace cca::baselines
