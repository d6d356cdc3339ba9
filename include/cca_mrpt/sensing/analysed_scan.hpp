// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/geometry/arc.hpp"
#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// A scan of one instant, and what it shows: found once, by analyse(), for localisation, mapping
/// and publication alike.
struct AnalysedScan {
  Scan scan;
  PointNoise noise;                ///< of its returns; with the straightness of walls
  std::vector<LineSegment> lines;  ///< of extractLines(), sensor frame
  std::vector<Arc> arcs = {};      ///< its curved walls, sensor frame
};

}  // namespace cca
