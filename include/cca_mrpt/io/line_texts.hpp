// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

/// A line map as CSV, header `x1,y1,x2,y2,id,support,length,sigma_offset,sigma_angle_deg`: end
/// points [m, map frame], stable id, laser returns, length [m], and the standard deviations of the
/// line's lateral offset at its centroid [m] and of its orientation [deg].
std::string linesCsv(const std::vector<MapLine>& lines);

}  // namespace cca
