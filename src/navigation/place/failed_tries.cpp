// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/failed_tries.hpp"

#include <algorithm>
#include <utility>

namespace cca {
namespace {

constexpr std::size_t kRetryAfter = 4000;  // cells newly seen: 10 m^2
constexpr int kSameTarget = 3;             // cells
constexpr double kSamePlace = 6.0;         // cells, that a robot is held at
constexpr double kAhead = 0.6;             // m, of a way that is barred
constexpr int kAside = 2;                  // cells, to both sides of it

bool isRecent(std::size_t revealed_then, std::size_t revealed) {
  return revealed < revealed_then + kRetryAfter;
}

bool isSameTarget(Cell a, Cell b) { return squareDistance(a, b) <= kSameTarget; }

/// The cells that the beginning of a way crosses.
std::vector<Cell> cellsAhead(const std::vector<Eigen::Vector2d>& way, double resolution) {
  std::vector<Cell> cells;
  double left = kAhead / resolution;
  for (std::size_t i = 1; i < way.size() && left > 0.0; ++i) {
    const Eigen::Vector2d from = way[i - 1] / resolution, step = way[i] / resolution - from;
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

bool FailedTries::add(Cell target, Failure failure, std::size_t revealed,
                      std::optional<Cell> held_at) {
  const bool is_aside =
      failure != Failure::kWayLost || std::any_of(tries_.begin(), tries_.end(), [&](const Try& t) {
        return t.failure == Failure::kWayLost && isSameTarget(t.target, target);
      });
  if (!is_aside) held_at.reset();
  tries_.push_back({target, failure, is_aside, revealed, held_at});
  return is_aside;
}

bool FailedTries::isAside(Cell target, std::size_t revealed) const {
  return std::any_of(tries_.begin(), tries_.end(), [&](const Try& t) {
    return t.is_aside && isSameTarget(t.target, target) && isRecent(t.revealed_then, revealed);
  });
}

int FailedTries::timesHeld() const {
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

void FailedTries::bar(const std::vector<Eigen::Vector2d>& way, double resolution,
                      std::size_t revealed, FreeSpace& space) {
  std::vector<Cell> cells;
  for (const Cell c : cellsAhead(way, resolution)) {
    for (int y = -kAside; y <= kAside; ++y) {
      for (int x = -kAside; x <= kAside; ++x) cells.push_back(c + Cell{x, y});
    }
  }
  if (cells.empty()) return;
  for (const Cell c : cells) space.bar(c, true);
  barred_.push_back({cellAt(way.front() / resolution), std::move(cells), revealed});
}

bool FailedTries::staysShut(const Barred& barred, std::size_t revealed) const {
  const auto times = std::count_if(barred_.begin(), barred_.end(), [&](const Barred& other) {
    return distanceBetween(other.held_at, barred.held_at) <= kSamePlace &&
           isRecent(other.revealed_then, revealed);
  });
  return times >= kMostTries;
}

bool FailedTries::open(std::size_t revealed, FreeSpace& space) {
  bool any = false;
  for (Barred& barred : barred_) {
    if (barred.cells.empty() || staysShut(barred, revealed)) continue;
    for (const Cell c : barred.cells) space.bar(c, false);
    barred.cells.clear();
    any = true;
  }
  // A cell may have been barred twice.
  for (const Barred& barred : barred_) {
    for (const Cell c : barred.cells) space.bar(c, true);
  }
  return any;
}

void FailedTries::move(const CellMove& moved, std::size_t revealed, FreeSpace& space) {
  for (Try& t : tries_) {
    t.target = moved(t.target);
    t.revealed_then = std::min(t.revealed_then, revealed);
    if (t.held_at) t.held_at = moved(*t.held_at);
  }
  for (Barred& barred : barred_) {
    barred.held_at = moved(barred.held_at);
    barred.revealed_then = std::min(barred.revealed_then, revealed);
    for (Cell& c : barred.cells) {
      c = moved(c);
      space.bar(c, true);
    }
  }
}

}  // namespace cca
