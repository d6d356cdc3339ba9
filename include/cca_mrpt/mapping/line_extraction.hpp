// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// The lines of one scan by the Consecutive Clustering Algorithm.
///
/// @param scan  any; fewer than three returns give no line.
/// @return      segments in the sensor frame (T_map_sensor is not used), ordered by bearing.
std::vector<LineSegment> extractLines(const Scan& scan, const CcaParameters& parameters = {});

}  // namespace cca
