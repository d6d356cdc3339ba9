// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "evaluation/log_score.hpp"
#include "evaluation/spatial_index.hpp"
#include "mapping/wall.hpp"

namespace cca {

/// Which lines are asked for their standard deviations, and which wall is theirs.
struct SigmaScoreParameters {
  double least_length = 1.0;  ///< m
  double tolerance = 0.10;    ///< m, from the middle of a line to its wall
  double angle_tolerance_deg = 10.0;
};

/// Whether the standard deviations of a map's lines are those of their errors.
///
/// Each line is compared with the true wall nearest to its middle; its errors of offset there and
/// of direction are divided by what it says that they are.
/// One group "sigmas": lines (compared), offset_median, offset_beyond_3, angle_median,
/// angle_beyond_3: median of the magnitude and share beyond 3. Of a normal variable: .674, .0027.
/// @param map  lines without variances are passed over.
/// Cost: O(truth x map).
ScoreGroup scoreSigmas(const std::vector<Segment2>& truth, const std::vector<MapLine>& map,
                       const SigmaScoreParameters& parameters = {});

}  // namespace cca
