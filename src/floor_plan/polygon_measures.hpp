// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/geometry/polygon.hpp"

namespace cca {

/// Whether a polygon with holes is one that other programs take: no side crosses another, holes lie
/// inside (OGC Simple Features, by Boost.Geometry).
bool isValidPolygon(const Polygon& outline, const std::vector<Polygon>& holes);

/// m^2 of a valid polygon, without its holes; m of its border, holes included.
double areaOf(const Polygon& outline, const std::vector<Polygon>& holes);
double perimeterOf(const Polygon& outline, const std::vector<Polygon>& holes);

}  // namespace cca
