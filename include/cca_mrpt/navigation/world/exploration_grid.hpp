// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/sensing/sensor_noise.hpp"

namespace cca {

enum class CellState : std::uint8_t {
  kUnknown,
  kPresumedFree,  ///< not seen, but between two neighbouring beams that both went on
  kPresumedWall,  ///< not seen, but between two neighbouring returns that look like one surface
  kFree,
  kOccupied,
};

/// Whether a cell was seen free, or is presumed so.
constexpr bool isFree(CellState state) {
  return state == CellState::kFree || state == CellState::kPresumedFree;
}

struct SurfacePoint;

/// What is known of each place. It grows as the robot moves.
///
/// A scan counts once in each cell: a return for it, otherwise a beam that passes against it, but
/// not where the scan sees a surface in the cell, which is passed before it. The evidence is
/// bounded, so what has moved away is forgotten after eight scans, and more where the sensor's
/// noise, learned from the scans, is not small beside a cell. A beam counts the less the farther it
/// may lie from where it is thought to be, and it passes only what its neighbours within the
/// bearing noise pass as well.
class ExplorationGrid {
 public:
  /// Cells. A return counts for the cell half a cell behind the surface, square to it: that cell's
  /// edge is the one nearest to the surface, and noise must be half a cell to thicken a wall, and
  /// with it close a passage. So a surface may lie this far before an occupied cell.
  static constexpr double kBehindSurface = 0.5;

  /// @param resolution  m, side of a cell.
  explicit ExplorationGrid(double resolution = 0.05) : resolution_(resolution) {}

  /// Traces the scan's beams from T_map_sensor; beams without return are free up to
  /// free_range_without_return; invalid ranges and poses leave the grid as it is.
  /// @param range_sigma  m, of the scan's ranges. Cost: cells crossed, whatever the grid's size.
  void insert(const Scan& scan, double range_sigma);
  /// The same of a scan that nobody has analysed yet.
  void insert(const Scan& scan);

  /// Declares a cell's state as known from elsewhere (a saved map): as sure as evidence gets.
  void set(Cell cell, CellState state);

  CellState at(Cell cell) const { return stateOf(evidence_.at(cell)); }

  /// Whether the face of an obstacle towards one of its neighbours was not seen: returns came from
  /// the opposite side of its cell and none from here, or it is a presumed wall, and the returns to
  /// its sides were farther apart than a wall's points may be. A cell that was set has been seen
  /// from all sides.
  /// @param side  where the neighbour is, one of the first four kNeighbours.
  bool isFaceUnseen(Cell cell, std::size_t side) const;

  /// Cells whose state, or whose faces that were seen, the last insert (or the sets since then)
  /// has changed; a cell may be listed more than once.
  const std::vector<Cell>& changed() const { return changed_; }

  /// Number of cells that have ever been seen.
  std::size_t revealed() const { return revealed_; }

  double resolution() const { return resolution_; }
  /// Whether a place (m, map frame) is finite and within what a grid can hold.
  bool covers(const Eigen::Vector2d& p_map) const {
    return p_map.allFinite() && p_map.cwiseAbs().maxCoeff() < resolution_ * kFarthestCell;
  }
  /// The cell that holds a point. @param p_map  m, finite.
  Cell cellOf(const Eigen::Vector2d& p_map) const { return cellAt(p_map / resolution_); }
  /// m, map frame.
  Eigen::Vector2d centreOf(Cell cell) const { return resolution_ * middleOf(cell); }

  /// All known cells lie in lowest() .. highest(), both included; highest() < lowest(): none.
  Cell lowest() const { return lowest_; }
  Cell highest() const { return highest_; }

 private:
  using Evidence = std::int8_t;
  /// Below all that evidence comes to.
  static constexpr Evidence kNever = -128, kFreePresumed = -127, kWallPresumed = -126;
  static CellState stateOf(Evidence e) {
    if (e > 0) return CellState::kOccupied;
    if (e > kWallPresumed) return CellState::kFree;
    if (e == kNever) return CellState::kUnknown;
    return e == kFreePresumed ? CellState::kPresumedFree : CellState::kPresumedWall;
  }
  void add(Cell cell, int weight);
  int weightOf(double variance) const;
  void findCertainRanges(const Scan& scan);
  void write(Cell cell, Evidence value) { write(cell, evidence_[cell], value); }
  void write(Cell cell, Evidence& evidence, Evidence value);
  void passThrough(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double length,
                   double ends_at);
  void markSurfaces(const std::vector<SurfacePoint>& points);
  void presumeFree(const Scan& scan);
  void noteFaces(Cell cell, unsigned sides);

  double resolution_;
  TiledGrid<Evidence> evidence_{kNever};
  TiledGrid<std::uint8_t> faces_{0};     ///< that returns came from, see exploration_grid.cpp
  TiledGrid<std::uint32_t> counted_{0};  ///< number of the last scan that counted here
  std::uint32_t scans_ = 0;
  std::size_t revealed_ = 0;
  std::vector<Cell> changed_;
  SensorNoise noise_;
  std::vector<double> certain_ranges_;       ///< m, that each beam is free up to, wherever it went
  std::vector<Eigen::Vector2d> directions_;  ///< of the scan's beams, map frame
  Cell lowest_{1, 1}, highest_{0, 0};
};

}  // namespace cca
