// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/cell.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "navigation/planning/planning_scene.hpp"

namespace cca {

/// A world drawn in text, '#' occupied, the last row at y = 0; each character is a square of
/// `scale` cells of 5 cm. All beyond the drawing is occupied.
struct KnownWorld {
  std::vector<std::string> rows;
  int scale = 1;

  int width() const { return scale * static_cast<int>(rows.front().size()); }
  int height() const { return scale * static_cast<int>(rows.size()); }
  bool isOccupied(Cell c) const {
    if (c.x < 0 || c.y < 0 || c.x >= width() || c.y >= height()) return true;
    const auto row = rows.size() - 1 - static_cast<std::size_t>(c.y / scale);
    return rows[row][static_cast<std::size_t>(c.x / scale)] == '#';
  }

  std::vector<Cell> freeCells() const { return cells(false); }
  std::vector<Cell> walls() const { return cells(true); }
  std::vector<Cell> cells(bool occupied) const {
    std::vector<Cell> cells;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        if (isOccupied({x, y}) == occupied) cells.push_back({x, y});
      }
    }
    return cells;
  }

  /// All that the world holds, as if it had been seen.
  ExplorationGrid seen() const {
    ExplorationGrid grid;
    for (int y = -1; y <= height(); ++y) {
      for (int x = -1; x <= width(); ++x)
        grid.set({x, y}, isOccupied({x, y}) ? CellState::kOccupied : CellState::kFree);
    }
    return grid;
  }

  /// A sweep of 361 beams over 360 degrees.
  Scan scanFrom(const Pose2& T_map_sensor, double range = 8.0) const {
    constexpr double kResolution = 0.05, kPi = 3.14159265358979323846;
    Scan scan;
    scan.angle_min = -kPi;
    scan.angle_increment = kPi / 180.0;
    scan.free_range_without_return = range;
    scan.T_map_sensor = T_map_sensor;
    for (int k = 0; k <= 360; ++k) {
      const double angle = T_map_sensor.theta + scan.angle_min + k * scan.angle_increment;
      double seen = std::numeric_limits<double>::infinity();
      walkBeam(T_map_sensor.position() / kResolution, {std::cos(angle), std::sin(angle)},
               range / kResolution, [&](Cell c, double entered) {
                 if (!isOccupied(c)) return true;
                 seen = entered * kResolution;
                 return false;
               });
      scan.ranges.push_back(seen);
    }
    return scan;
  }
};

/// Free but for a share of single occupied cells.
inline KnownWorld randomWorld(unsigned seed, int side, double share) {
  std::mt19937 random(seed);
  KnownWorld world;
  for (int y = 0; y < side; ++y) {
    std::string row;
    for (int x = 0; x < side; ++x)
      row += static_cast<double>(random()) / 4294967296.0 < share ? '#' : '.';
    world.rows.push_back(row);
  }
  return world;
}

/// A world model, with what a planner keeps beside it.
struct KnownScene {
  WorldModel world;
  GoalBlacklist blacklist;
  DistanceField distances;
  PlanningScene scene{world, blacklist, distances};

  explicit KnownScene(double clearance = 0.27) : world(clearance) {}
  KnownScene(const KnownScene&) = delete;
};

/// A corridor of 20 m of which much is known, in squares of 20 cm; not what is in the slots of
/// its upper wall.
/// @param slots  the first of two squares of each.
inline KnownWorld showCorridor(WorldModel& world, const std::vector<std::size_t>& slots) {
  std::string wall(100, '#');
  for (const std::size_t slot : slots) wall.replace(slot, 2, "..");
  std::vector<std::string> rows(8, '#' + std::string(98, '.') + '#');
  rows.insert(rows.begin(), wall);
  rows.push_back(std::string(100, '#'));
  const KnownWorld corridor{rows, 4};
  std::vector<Cell> known = corridor.freeCells();
  known.erase(std::remove_if(known.begin(), known.end(), [](Cell c) { return c.y >= 36; }),
              known.end());
  world.seed(corridor.walls(), CellState::kOccupied);
  world.seed(known, CellState::kFree);
  return corridor;
}

}  // namespace cca
