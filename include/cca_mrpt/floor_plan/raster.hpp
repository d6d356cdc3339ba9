// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cca_mrpt/geometry/cell.hpp"

namespace cca {

/// A value for each square cell of a rectangle of the plane. Cell (0, 0) is the lower left one.
template <class T>
struct Raster {
  int columns = 0, rows = 0;
  double resolution = 0.05;                          ///< m, > 0
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: lower left corner
  std::vector<T> values;                             ///< row by row, from the bottom

  /// Another raster over the same cells.
  template <class U>
  Raster<U> alike(U value) const {
    return {columns, rows, resolution, origin, std::vector<U>(values.size(), value)};
  }

  bool holds(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < columns && c.y < rows; }
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(c.x);
  }
  Cell cell(std::size_t index) const {
    const auto wide = static_cast<std::size_t>(columns);
    return {static_cast<int>(index % wide), static_cast<int>(index / wide)};
  }
  /// Precondition of both: holds(c).
  T& operator[](Cell c) { return values[index(c)]; }
  const T& operator[](Cell c) const { return values[index(c)]; }
  /// The value of a cell, `beyond` outside of the rectangle.
  T at(Cell c, T beyond) const { return holds(c) ? values[index(c)] : beyond; }

  /// m, map frame -> cells, and back.
  Eigen::Vector2d inCells(const Eigen::Vector2d& p_map) const {
    return (p_map - origin) / resolution;
  }
  Eigen::Vector2d inMetres(const Eigen::Vector2d& p_cells) const {
    return origin + resolution * p_cells;
  }
  Cell cellOf(const Eigen::Vector2d& p_map) const { return cellAt(inCells(p_map)); }
  Eigen::Vector2d centreOf(Cell c) const { return inMetres(middleOf(c)); }
};

enum class Occupancy : std::uint8_t { kUnknown, kFree, kOccupied };
using OccupancyRaster = Raster<Occupancy>;
using Mask = Raster<std::uint8_t>;  ///< 0 or 1

/// The cells that a segment crosses, in order. @param a, b  m, map frame, finite.
template <class T>
std::vector<Cell> cellsAlong(const Raster<T>& raster, const Eigen::Vector2d& a,
                             const Eigen::Vector2d& b) {
  const Eigen::Vector2d from = raster.inCells(a), way = raster.inCells(b) - from;
  const double length = way.norm();
  std::vector<Cell> cells;
  const Eigen::Vector2d direction =
      length > 0.0 ? Eigen::Vector2d(way / length) : Eigen::Vector2d(1.0, 0.0);
  walkBeam(from, direction, length, [&](Cell c, double) {
    if (raster.holds(c)) cells.push_back(c);
    return true;
  });
  return cells;
}

}  // namespace cca
