// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/known_place.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr std::size_t kShortestFace = 10;  // cells: legs of furniture have no face worth its way
constexpr double kLongestStep = 0.5;       // m, between scans; a farther one is a jump

}  // namespace

void KnownPlace::observe(const Scan& scan, const Eigen::Vector2d& robot_map) {
  learnRange(scan);
  grid_.insert(scan);
  if (grid_.covers(robot_map)) presumeFreeBelow(robot_map);
  takeChanges();
  if (!grid_.covers(robot_map)) return;
  notePassage(robot_map);
  scanned_.add(grid_.cellOf(robot_map), scan);
}

void KnownPlace::learnRange(const Scan& scan) {
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double seen = scan.freeRange(beam);
    if (isReturn(seen)) laser_range_ = std::max(laser_range_, seen);
  }
}

// Lasers that look away from the robot never see where it stands.
void KnownPlace::presumeFreeBelow(const Eigen::Vector2d& robot_map) {
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

void KnownPlace::notePassage(const Eigen::Vector2d& robot_map) {
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

void KnownPlace::seed(const std::vector<Cell>& cells, CellState state) {
  for (const Cell c : cells) grid_.set(c, state);
  takeChanges();
}

void KnownPlace::heed(const std::vector<Eigen::Vector2d>& places_map) {
  for (const Eigen::Vector2d& p_map : places_map) {
    if (grid_.covers(p_map)) grid_.set(grid_.cellOf(p_map), CellState::kOccupied);
  }
  takeChanges();
}

void KnownPlace::noteScanned(Cell c) {
  scanned_.addAll(c);
  noted_scanned_.push_back(c);
}

CellMove KnownPlace::correct(const PastScans& past) {
  KnownPlace anew(space_.clearance());
  for (const auto& kept : past.kept()) anew.observe(kept.seen.scan, kept.T_map_robot.position());
  const CellMove moved = [&past, grid = ExplorationGrid(grid_.resolution())](Cell c) {
    const Eigen::Vector2d p_was = grid.centreOf(c);
    return grid.cellOf(past.correctionAt(p_was) * p_was);
  };
  for (const Cell c : noted_scanned_) anew.noteScanned(moved(c));
  anew.failed_ = std::move(failed_);
  anew.failed_.move(moved, anew.grid_.revealed(), anew.space_);
  *this = std::move(anew);
  return moved;
}

void KnownPlace::takeChanges() {
  space_.update(grid_, grid_.changed());
  frontier_cells_.update(grid_, grid_.changed());
  face_cells_.update(grid_, grid_.changed());
}

void KnownPlace::findWays(const Eigen::Vector2d& from_map, std::optional<Cell> until) {
  ways_.search(space_, grid_.resolution(), grid_.cellOf(from_map), until);
}

CellSet KnownPlace::openings(std::size_t smallest_frontier) const {
  CellSet openings;
  for (const Frontier& frontier : frontiers()) {
    if (frontier.cells.size() < smallest_frontier) continue;
    for (const Cell c : frontier.cells) openings.insert(c);
  }
  for (const Frontier& face : face_cells_.frontiers(kFrontierExtent)) {
    if (face.cells.size() < kShortestFace) continue;
    for (const Cell c : face.cells) openings.insert(c);
  }
  return openings;
}

}  // namespace cca
