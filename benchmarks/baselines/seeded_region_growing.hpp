// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct SeededRegionGrowingParameters {
  double distance = 0.03;           ///< m
  double predicted_distance = 0.1;  ///< m
  int seed_points = 6;
  SegmentLimits limits{10, 0.6};
  static SeededRegionGrowingParameters tuned();
};

template <class Field>
void describe(SeededRegionGrowingParameters& p, Field&& field) {
  field("distance", p.distance, 0.005, 0.5, "m", "largest distance of a point from the line");
  field("predicted_distance", p.predicted_distance, 0.02, 1.0, "m",
        "largest distance of a point from where its beam meets the line");
  field("seed_points", p.seed_points, 3, 15, "points", "points of a seed");
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
}

/// Seeded region growing [Gao, Zhang, Yuan et al. 2018, Int. J. Advanced Robotic Systems].
///
/// A seed is a window of neighbouring points that all lie near their line and near where their
/// beams meet it. It grows forwards and backwards, refitted with each point. Points claimed by two
/// lines go to the nearer one. Defaults are those of the authors' published launch file.
/// @return  segments in the sensor frame, by bearing. Cost: O(n) but for the seeds, O(n seed).
std::vector<LineSegment> seededRegionGrowing(const Scan& scan,
                                             const SeededRegionGrowingParameters& p = {});

}  // namespace cca::baselines
