// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/navigation/place/failed_tries.hpp"
#include "cca_mrpt/navigation/place/free_space.hpp"
#include "cca_mrpt/navigation/place/frontier.hpp"
#include "cca_mrpt/navigation/place/grid_paths.hpp"
#include "cca_mrpt/sensing/beam.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/scan.hpp"

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

  /// All directions, wherever the laser has looked.
  void addAll(Cell robot) { looked_[FreeSpace::blockOf(robot)] = kAllAround; }

  bool contains(Cell c) const { return looked_.at(FreeSpace::blockOf(c)) == kAllAround; }

  static constexpr std::uint32_t kAllAround = 0xFFFFFFFF;

 private:
  TiledGrid<std::uint32_t> looked_{0};  ///< the directions, a bit each
};

/// What is known of the place: what the laser has seen, where the robot can be, the shortest ways,
/// the frontiers, and from where there is nothing more to see.
class KnownPlace {
 public:
  /// @param clearance  m, that ways keep from known obstacles.
  explicit KnownPlace(double clearance) : space_(clearance, grid_.resolution()) {}

  /// Takes a scan. A robot that is nowhere on the grid, or not finite, adds what it saw and no
  /// passage. Cost: cells crossed by the scan.
  void observe(const Scan& scan, const Eigen::Vector2d& robot_map);

  /// Makes everything anew from scans whose poses were corrected, and moves what was barred along.
  /// @return where cells got to. Cost: that of observing all the scans.
  CellMove correct(const PastScans& past);

  /// Declares cells as known, obstacles before what is free beside them (see FreeSpace), until the
  /// place is corrected.
  void seed(const std::vector<Cell>& cells, CellState state);

  /// Takes places (m, map frame) for occupied, whatever the laser saw there: in its plane it may
  /// soon see them free again, so they are to be told with each scan for as long as they count.
  void heed(const std::vector<Eigen::Vector2d>& places_map);

  /// Nothing more will be seen from a cell, wherever the laser has looked.
  void noteScanned(Cell c);

  /// Shuts the beginning of a way (m, map frame) that could not be driven, see FailedTries.
  void bar(const std::vector<Eigen::Vector2d>& way) {
    failed_.bar(way, grid_.resolution(), grid_.revealed(), space_);
  }
  /// Opens what was barred and may be tried again. @return whether there was any.
  bool open() { return failed_.open(grid_.revealed(), space_); }

  /// Notes that what was to show a target failed, see FailedTries::add().
  bool noteFailure(Cell target, Failure failure, std::optional<Cell> held_at = {}) {
    return failed_.add(target, failure, grid_.revealed(), held_at);
  }
  /// Whether a target was set aside, and may not be tried again yet.
  bool isAside(Cell target) const { return failed_.isAside(target, grid_.revealed()); }
  /// Whether the robot was held at one place in all of its last tries, as often as it may.
  bool isHeld() const { return failed_.timesHeld() >= FailedTries::kMostTries; }

  /// Finds the shortest ways from a place (m, map frame) anew: to everywhere, or at least to
  /// `until`. Cost: O(known blocks).
  void findWays(const Eigen::Vector2d& from_map, std::optional<Cell> until = std::nullopt);
  /// The ways last found.
  const DistanceField& ways() const { return ways_; }
  /// The shortest of them to a cell: corners, m, map frame; empty where there is none.
  std::vector<Eigen::Vector2d> wayTo(Cell goal) const {
    return shortestPath(space_, grid_.resolution(), ways_, goal);
  }

  /// See FrontierCells::frontiers(); those longer than 2 m are several.
  std::vector<Frontier> frontiers() const { return frontier_cells_.frontiers(kFrontierExtent); }
  /// The cells of all frontiers of at least so many cells: a small one may be a missing cell of a
  /// wall, which would promise all that is behind it. And those beside faces of walls that were not
  /// seen, half a metre of them at least. Cost: O(frontier cells).
  CellSet openings(std::size_t smallest_frontier) const;

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
  /// m, the longest that a beam was seen to be free; 1 at least.
  double laserRange() const { return laser_range_; }

 private:
  static constexpr int kFrontierExtent = 40;  // cells

  void learnRange(const Scan& scan);
  void presumeFreeBelow(const Eigen::Vector2d& robot_map);
  void notePassage(const Eigen::Vector2d& robot_map);
  void takeChanges();

  ExplorationGrid grid_;
  FreeSpace space_;
  FrontierCells frontier_cells_, face_cells_{isBesideUnseenFace};
  ScannedPlaces scanned_;
  std::vector<Cell> noted_scanned_;
  FailedTries failed_;
  DistanceField ways_;
  std::optional<Eigen::Vector2d> last_place_;
  double laser_range_ = 1.0;
};

}  // namespace cca
