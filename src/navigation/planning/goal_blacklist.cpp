// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/goal_blacklist.hpp"

#include <algorithm>
#include <utility>

namespace cca {
namespace {

constexpr std::size_t kRetryAfter = 4000;  // cells newly seen: 10 m^2
constexpr int kSameTarget = 3;             // cells: the edge of the unknown moves as it is seen
constexpr double kSamePlace = 6.0;         // cells, that a robot is held at
constexpr double kAhead = 0.6;             // m, of a path that is blocked
constexpr int kAside = 2;                  // cells, to both sides of it

bool isRecent(std::size_t revealed_then, std::size_t revealed) {
  return revealed < revealed_then + kRetryAfter;
}

bool isSameTarget(Cell a, Cell b) { return squareDistance(a, b) <= kSameTarget; }

/// The cells that the beginning of a path crosses.
std::vector<Cell> cellsAhead(const std::vector<Eigen::Vector2d>& path, double resolution) {
  std::vector<Cell> cells;
  double left = kAhead / resolution;
  for (std::size_t i = 1; i < path.size() && left > 0.0; ++i) {
    const Eigen::Vector2d from = path[i - 1] / resolution, step = path[i] / resolution - from;
    const double length = step.norm();
    if (length == 0.0) continue;
    walkBeam(from, step / length, std::min(length, left), [&](Cell c, double) {
      cells.push_back(c);
      return true;
    });
    left -= length;
  }
  return cells;
}

}  // namespace

bool GoalBlacklist::add(Cell target, Failure failure, std::size_t revealed,
                        std::optional<Cell> held_at) {
  const bool is_blacklisted =
      failure != Failure::kPathLost || std::any_of(tries_.begin(), tries_.end(), [&](const Try& t) {
        return t.failure == Failure::kPathLost && isSameTarget(t.target, target);
      });
  if (!is_blacklisted) held_at.reset();
  tries_.push_back({target, failure, is_blacklisted, revealed, held_at});
  return is_blacklisted;
}

bool GoalBlacklist::contains(Cell target, std::size_t revealed) const {
  return std::any_of(tries_.begin(), tries_.end(), [&](const Try& t) {
    return t.is_blacklisted && isSameTarget(t.target, target) &&
           isRecent(t.revealed_then, revealed);
  });
}

int GoalBlacklist::timesHeld() const {
  int times = 0;
  std::optional<Cell> place;
  for (auto t = tries_.rbegin(); t != tries_.rend(); ++t) {
    if (t->failure == Failure::kNothingSeen) break;  // it got away
    if (!t->held_at) continue;
    if (place && distanceBetween(*place, *t->held_at) > kSamePlace) break;
    place = t->held_at;
    ++times;
  }
  return times;
}

void GoalBlacklist::addExhausted(Cell c) {
  if (isExhausted(c)) return;
  exhausted_[FreeSpace::blockOf(c)] = 1;
  exhausted_cells_.push_back(c);
}

void GoalBlacklist::blockPath(const std::vector<Eigen::Vector2d>& path, double resolution,
                              std::size_t revealed) {
  std::vector<Cell> cells;
  for (const Cell c : cellsAhead(path, resolution)) {
    for (int y = -kAside; y <= kAside; ++y) {
      for (int x = -kAside; x <= kAside; ++x) {
        if (isStorable(c + Cell{x, y})) cells.push_back(c + Cell{x, y});
      }
    }
  }
  if (cells.empty()) return;
  paths_.push_back({cellAt(path.front() / resolution), std::move(cells), revealed});
  markBlockedCells();
}

bool GoalBlacklist::staysBlocked(const BlockedPath& path, std::size_t revealed) const {
  const auto times = std::count_if(paths_.begin(), paths_.end(), [&](const BlockedPath& other) {
    return distanceBetween(other.held_at, path.held_at) <= kSamePlace &&
           isRecent(other.revealed_then, revealed);
  });
  return times >= kMostTries;
}

bool GoalBlacklist::unblock(std::size_t revealed) {
  bool any = false;
  for (BlockedPath& path : paths_) {
    if (path.cells.empty() || staysBlocked(path, revealed)) continue;
    path.cells.clear();
    any = true;
  }
  if (any) markBlockedCells();
  return any;
}

void GoalBlacklist::markBlockedCells() {
  blocked_ = BlockedCells();
  for (const BlockedPath& path : paths_) {
    for (const Cell c : path.cells) {
      std::uint16_t& bits = blocked_[FreeSpace::blockOf(c)];
      bits = static_cast<std::uint16_t>(bits | FreeSpace::bitOf(c));
    }
  }
}

void GoalBlacklist::reindex(const CellMove& moved, std::size_t revealed) {
  for (Try& t : tries_) {
    t.target = moved(t.target);
    t.revealed_then = std::min(t.revealed_then, revealed);
    if (t.held_at) t.held_at = moved(*t.held_at);
  }
  for (BlockedPath& path : paths_) {
    path.held_at = moved(path.held_at);
    path.revealed_then = std::min(path.revealed_then, revealed);
    for (Cell& c : path.cells) c = moved(c);
  }
  markBlockedCells();
  const std::vector<Cell> exhausted = std::exchange(exhausted_cells_, {});
  exhausted_ = TiledGrid<char>(0);
  for (const Cell c : exhausted) addExhausted(moved(c));
}

}  // namespace cca
