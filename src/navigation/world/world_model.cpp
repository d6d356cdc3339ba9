// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/world_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

constexpr std::size_t kShortestFace = 10;  // cells: legs of furniture have no face worth its way
constexpr double kLongestStep = 0.5;       // m, between scans; a farther one is a jump

}  // namespace

void WorldModel::observe(const Scan& scan, const Eigen::Vector2d& robot_map) {
  observe(scan, robot_map, rangeNoise(scan).range_sigma);
}

void WorldModel::observe(const Scan& scan, const Eigen::Vector2d& robot_map, double range_sigma) {
  learnRange(scan);
  grid_.insert(scan, range_sigma);
  if (grid_.covers(robot_map)) presumeFreeBelow(robot_map);
  takeChanges();
  if (!grid_.covers(robot_map)) return;
  notePassage(robot_map);
  scanned_.add(grid_.cellOf(robot_map), scan);
}

void WorldModel::learnRange(const Scan& scan) {
  for (std::size_t beam = 0; beam + 1 < scan.size(); ++beam) {
    const double seen = scan.freeRange(beam), beside = scan.freeRange(beam + 1);
    if (isReturn(seen) && isReturn(beside)) {
      laser_range_ = std::max(laser_range_, std::min(seen, beside));
    }
  }
}

// Lasers that look away from the robot never see where it stands.
void WorldModel::presumeFreeBelow(const Eigen::Vector2d& robot_map) {
  const double reach = space_.clearance() / grid_.resolution() - 1.0;
  const int cells = static_cast<int>(reach);
  const Cell here = grid_.cellOf(robot_map);
  for (int y = -cells; y <= cells; ++y) {
    for (int x = -cells; x <= cells; ++x) {
      const Cell c = here + Cell{x, y};
      if (std::hypot(x, y) > reach || grid_.at(c) != CellState::kUnknown) continue;
      grid_.set(c, CellState::kPresumedFree);
    }
  }
}

void WorldModel::notePassage(const Eigen::Vector2d& robot_map) {
  const Eigen::Vector2d from = last_place_.value_or(robot_map) / grid_.resolution();
  const Eigen::Vector2d step = robot_map / grid_.resolution() - from;
  const double length = step.norm();
  last_place_ = robot_map;
  if (length == 0.0 || length > kLongestStep / grid_.resolution()) return;
  walkBeam(from, step / length, length, [&](Cell c, double) {
    space_.pass(c);
    return true;
  });
}

void WorldModel::seed(const std::vector<Cell>& cells, CellState state) {
  for (const Cell c : cells) grid_.set(c, state);
  takeChanges();
}

void WorldModel::markHazards(const std::vector<Eigen::Vector2d>& places_map) {
  if (places_map.empty()) return;
  for (const Eigen::Vector2d& p_map : places_map) {
    if (grid_.covers(p_map)) grid_.set(grid_.cellOf(p_map), CellState::kOccupied);
  }
  takeChanges();
}

CellMove WorldModel::correct(const PastScans& past) {
  WorldModel anew(space_.clearance());
  for (const auto& kept : past.kept()) {
    anew.observe(kept.seen.scan, kept.T_map_robot.position(), kept.seen.noise.range_sigma);
  }
  *this = std::move(anew);
  return [&past, grid = ExplorationGrid(grid_.resolution())](Cell c) {
    const Eigen::Vector2d p_was = grid.centreOf(c);
    return grid.cellOf(past.correctionAt(p_was) * p_was);
  };
}

void WorldModel::takeChanges() {
  space_.update(grid_, grid_.changed());
  frontier_cells_.update(grid_, grid_.changed());
  face_cells_.update(grid_, grid_.changed());
}

CellSet WorldModel::usefulFrontierCells(std::size_t smallest_frontier) const {
  CellSet frontier_cells;
  for (const Frontier& frontier : frontiers()) {
    if (frontier.cells.size() < smallest_frontier) continue;
    for (const Cell c : frontier.cells) frontier_cells.insert(c);
  }
  for (const Frontier& face : face_cells_.frontiers(kFrontierExtent)) {
    if (face.cells.size() < kShortestFace) continue;
    for (const Cell c : face.cells) frontier_cells.insert(c);
  }
  return frontier_cells;
}

}  // namespace cca
