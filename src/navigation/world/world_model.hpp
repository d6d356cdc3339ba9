// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "navigation/world/free_space.hpp"
#include "navigation/world/frontier.hpp"
#include "sensing/beam.hpp"

namespace cca {

/// The places from which all directions have been looked into, by blocks of the free space (0.2 m):
/// nothing more is to be seen from there, so they are no goals.
class ScannedPlaces {
 public:
  /// Takes the directions (map frame) that a scan looks into, in 32 sectors. Scans of a narrow
  /// field of view add up.
  void add(Cell robot, const Scan& scan) {
    looked_[FreeSpace::blockOf(robot)] |= sectorsInView(scan);
  }

  bool contains(Cell c) const { return looked_.at(FreeSpace::blockOf(c)) == kAllAround; }

 private:
  static constexpr std::uint32_t kAllAround = 0xFFFFFFFF;  ///< a bit for each of 32 sectors
  TiledGrid<std::uint32_t> looked_{0};                     ///< the directions, a bit each
};

/// What is known of the world: what the laser has seen, where the robot can be, the frontiers, and
/// from where there is nothing more to see. It changes by what is observed, and by nothing else.
class WorldModel {
 public:
  /// @param clearance  m, that paths keep from known obstacles.
  explicit WorldModel(double clearance = 0.30) : space_(clearance, grid_.resolution()) {}

  /// Takes a scan. A robot that is nowhere on the grid, or not finite, adds what it saw and no
  /// passage. @param range_sigma  m, of the scan's ranges. Cost: cells crossed by the scan.
  void observe(const Scan& scan, const Eigen::Vector2d& robot_map, double range_sigma);
  /// The same of a scan that nobody has analysed yet.
  void observe(const Scan& scan, const Eigen::Vector2d& robot_map);

  /// Makes everything anew from scans whose poses were corrected.
  /// @return where cells got to. Cost: that of observing all the scans.
  CellMove correct(const PastScans& past);

  /// Declares cells as known, obstacles before what is free beside them (see FreeSpace), until the
  /// world is corrected.
  void seed(const std::vector<Cell>& cells, CellState state);

  /// Takes places (m, map frame) for occupied, whatever the laser saw there: in its plane it may
  /// soon see them free again, so they are to be told with each scan for as long as they count.
  void markHazards(const std::vector<Eigen::Vector2d>& places_map);

  static constexpr int kFrontierExtent = 40;  ///< cells, 2 m: as much as a near view shows well
  /// See FrontierCells::frontiers(); those longer than 2 m are several.
  std::vector<Frontier> frontiers() const { return frontier_cells_.frontiers(kFrontierExtent); }
  /// The cells of all frontiers of at least so many cells: a small one may be a missing cell of a
  /// wall, which would promise all that is behind it. And those beside faces of walls that were not
  /// seen, half a metre of them at least. Cost: O(frontier cells).
  CellSet usefulFrontierCells(std::size_t smallest_frontier) const;

  const ExplorationGrid& grid() const { return grid_; }
  const FreeSpace& space() const { return space_; }
  const FrontierCells& frontierCells() const { return frontier_cells_; }
  /// Whether a cell is still to be seen: it is unknown, or beside a face that is.
  bool isUnseen(Cell c) const {
    return grid_.at(c) == CellState::kUnknown || face_cells_.all().contains(c);
  }
  const ScannedPlaces& scanned() const { return scanned_; }
  /// m, map frame: where the robot was at the last scan.
  const std::optional<Eigen::Vector2d>& lastPlace() const { return last_place_; }
  /// m, the longest that two neighbouring beams were seen to be free; 1 at least. A false return
  /// beyond the range of the laser lies alone.
  double laserRange() const { return laser_range_; }

 private:
  void learnRange(const Scan& scan);
  void presumeFreeBelow(const Eigen::Vector2d& robot_map);
  void notePassage(const Eigen::Vector2d& robot_map);
  void takeChanges();

  ExplorationGrid grid_;
  FreeSpace space_;
  FrontierCells frontier_cells_, face_cells_{isBesideUnseenFace};
  ScannedPlaces scanned_;
  std::optional<Eigen::Vector2d> last_place_;
  double laser_range_ = 1.0;
};

}  // namespace cca
