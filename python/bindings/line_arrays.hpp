// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <vector>

#include "mapping/wall.hpp"

namespace cca::python {

namespace nb = nanobind;

/// Adds the dtypes of the arrays below to the module: LINE and MAP_LINE.
void addLineTypes(nb::module_& module);

/// Structured NumPy arrays, one record a line: `ends` (2, 2), `covariance` (2, 2), `returns`; for
/// lines of a map also `id`.
nb::object lineArray(const std::vector<LineSegment>& lines);
nb::object lineArray(const std::vector<MapLine>& lines);

/// (n, 2) array of points.
nb::object pointArray(const std::vector<Eigen::Vector2d>& points);

}  // namespace cca::python
