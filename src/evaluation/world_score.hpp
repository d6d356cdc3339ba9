// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "evaluation/log_score.hpp"
#include "evaluation/spatial_index.hpp"

namespace cca {

/// When a piece of map counts as a piece of a true wall.
struct WorldScoreParameters {
  double tolerance = 0.10;
  double angle_tolerance_deg = 10.0;
  double step = 0.05;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(WorldScoreParameters& p, Field&& field) {
  field("tolerance", p.tolerance, 0.001, 10.0, "m", "largest distance from the true segment");
  field("angle_tolerance_deg", p.angle_tolerance_deg, 0.1, 90.0, "deg",
        "largest angle to the true segment");
  field("step", p.step, 0.001, 1.0, "m", "spacing of samples along map and truth");
}

/// Judges a map against the true segments of a world.
///
/// A sample of the map is right where a true segment lies within both tolerances; a sample of the
/// truth is found where a segment of the map does (so one face of a thin wall finds both). Where
/// more parallel lines of the map lie beside each other than true ones, their length counts as
/// (true ones) / (lines), and is redundant.
/// One group "world": truth_length_m, map_length_m, segments, precision, recall, f1 (all of
/// length), lateral_rms_m, lateral_median_m (right samples to their true line), angle_mean_deg
/// (weighted by length), end_error_median_m and end_error_p90_m (an end of the map to the nearest
/// true end), vertices_found (share of true ends with an end of the map within the tolerance),
/// vertices_right (share of the map's ends with a true end within it), redundant.
/// @param truth  world frame, at least one segment with length, else std::runtime_error.
/// @param map    world frame; may be empty (recall 0, precision NaN).
/// Cost: O((truth + map) length / step x log segments).
LogScore scoreAgainstWorld(const std::vector<Segment2>& truth, const std::vector<Segment2>& map,
                           const WorldScoreParameters& parameters = {});

}  // namespace cca
