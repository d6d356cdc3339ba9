// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "evaluation/spatial_index.hpp"

namespace cca {

/// How a line map is judged against the scans that it was made from; no floor plan is needed.
struct LogScoreParameters {
  double range_max = 20.0;
  double range_near = 8.0;
  double smear = 0.03;
  double cell = 0.05;
  double step = 0.05;
  int max_points = 300000;
  int max_ray_scans = 400;
  double free_space_margin = 0.20;
  double free_space_depth = 0.10;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(LogScoreParameters& p, Field&& field) {
  field("range_max", p.range_max, 0.1, 1000.0, "m", "end points used for recall and rays");
  field("range_near", p.range_near, 0.1, 1000.0, "m", "a second, nearer set of end points");
  field("smear", p.smear, 0.001, 1.0, "m", "standard deviation of the correlation's kernel");
  field("cell", p.cell, 0.01, 1.0, "m", "side of the cells that end points are counted in");
  field("step", p.step, 0.005, 1.0, "m", "spacing of samples along the map");
  field("max_points", p.max_points, 1000, 100000000, "", "end points beyond this are thinned");
  field("max_ray_scans", p.max_ray_scans, 1, 1000000, "", "scans whose rays are tested");
  field("free_space_margin", p.free_space_margin, 0.0, 10.0, "m",
        "how far before its end point a ray must cross a line to speak against it");
  field("free_space_depth", p.free_space_depth, 0.0, 10.0, "m",
        "how far behind the line, measured across it, that end point must lie");
}

/// A group of figures in the order of their names; NaN where a figure does not exist.
struct ScoreGroup {
  std::string name;
  std::vector<std::pair<std::string, double>> figures;

  /// @throws std::out_of_range for a name that is not there.
  double at(const std::string& figure) const;
};

/// Groups "map", "points", "cells", "phantom", "bias", "redundancy", "free_space", "size",
/// "summary".
struct LogScore {
  std::vector<ScoreGroup> groups;

  const ScoreGroup& at(const std::string& group) const;
};

/// Judges a map by recall (cells whose surroundings are a thin line, within 10 cm), precision
/// (length that is supported, not contradicted by rays, and counted once), lateral bias,
/// redundancy, free space and description length. Meaning of each figure: docs/evaluation.md.
///
/// @param scans  at T_map_sensor; returns under 5 cm are not counted. At least one return, else
///               std::runtime_error.
/// @param map    map frame; segments without length are passed over.
/// Cost: O(points log points + segments x rays of max_ray_scans scans).
LogScore scoreAgainstLog(const std::vector<Scan>& scans, const std::vector<Segment2>& map,
                         const LogScoreParameters& parameters = {});

}  // namespace cca
