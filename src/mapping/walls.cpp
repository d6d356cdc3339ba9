// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/walls.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

constexpr double kFoundFrom = 0.3;  // m, a wall is found from this far away
constexpr int kSlack = 10;          // bins that a wall may grow before it is indexed anew
// Against what comes to stand where something was refuted: as many as do not refute it by
// themselves, or no return of it would ever count.
constexpr double kRaysOfFreed = 4.0;
constexpr double kBeside = 0.1;  // m, within which walls with one front are merged
constexpr double kFreed = 0.3;   // m, cell of a freed place: a chair's leg and its next place

std::pair<long, long> freedPlace(const Eigen::Vector2d& p_map) {
  return {std::lround(std::floor(p_map.x() / kFreed)), std::lround(std::floor(p_map.y() / kFreed))};
}

}  // namespace

Walls::Slot Walls::create() {
  if (free_.empty()) {
    free_.push_back(static_cast<Slot>(walls_.size()));
    walls_.emplace_back();
  }
  const Slot slot = free_.back();
  free_.pop_back();
  (*this)[slot].alive = true;
  return slot;
}

void Walls::remove(Slot slot) {
  Wall& wall = (*this)[slot];
  index_.remove(slot, wall.cells);
  wall = Wall{};
  dead_.push_back(slot);
}

void Walls::recycle() {
  free_.insert(free_.end(), dead_.begin(), dead_.end());
  dead_.clear();
}

void Walls::place(Slot slot) {
  Wall& wall = (*this)[slot];
  const BinRange now{wall.profile.first(), wall.profile.last()};
  if (!wall.cells.empty() && now.first >= wall.indexed.first && now.last <= wall.indexed.last)
    return;
  index_.remove(slot, wall.cells);
  wall.cells.clear();
  wall.indexed = {now.first - kSlack, now.last + kSlack};
  const double b = SupportProfile::kBinLength;
  index_.insert(slot, wall.onLine(now.first * b - 0.2), wall.onLine(now.last * b + 0.2), kFoundFrom,
                wall.cells);
}

void Walls::near(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 std::vector<Slot>& found) const {
  found.clear();
  const int steps = 1 + static_cast<int>((to - from).norm() / WallIndex::kCellSize * 2.0);
  WallIndex::Cell before = WallIndex::cellOf(from) - WallIndex::Cell(1, 1);
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = from + (to - from) * (static_cast<double>(i) / steps);
    const WallIndex::Cell cell = WallIndex::cellOf(p);
    if (cell == before) continue;
    before = cell;
    for (const Slot slot : index_.at(cell)) {
      if (std::find(found.begin(), found.end(), slot) == found.end()) found.push_back(slot);
    }
  }
}

template <class Visit>
void Walls::visitHitBy(const Eigen::Vector2d& p, const Eigen::Vector2d& viewpoint, double gate,
                       const Visit& visit) const {
  for (const Slot slot : index_.at(WallIndex::cellOf(p))) {
    const Wall& wall = (*this)[slot];
    const Eigen::Vector2d td = wall.toWall(p);
    const double off = std::abs(wall.offLine(td));
    if (off >= gate) continue;
    const int i = SupportProfile::binOf(td.x());
    if (!wall.profile.contains(i) || wall.profile.bin(i).hits() <= 0.0) continue;
    if (!wall.two_sided && wall.toWall(viewpoint).y() < 0.0) continue;
    visit(slot, off);
  }
}

Walls::Slot Walls::hitBy(const Eigen::Vector2d& p, const Eigen::Vector2d& viewpoint,
                         double gate) const {
  double nearest = gate;
  Slot best = -1;
  visitHitBy(p, viewpoint, gate, [&](Slot slot, double off) {
    if (off >= nearest) return;
    nearest = off;
    best = slot;
  });
  return best;
}

Walls::Slot Walls::likelyHitBy(const Eigen::Vector2d& p, const Eigen::Vector2d& viewpoint,
                               const MapNoise& noise) const {
  const double variance = noise.lateralVariance((p - viewpoint).norm());
  double highest = 0.0;
  Slot best = -1;
  visitHitBy(p, viewpoint, kGates * std::sqrt(variance), [&](Slot slot, double off) {
    const Wall& wall = (*this)[slot];
    const double per_metre = wall.profile.tally().returns.w / extentOf(wall).length();
    const double density = per_metre * std::exp(-0.5 * off * off / variance);
    if (density <= highest) return;
    highest = density;
    best = slot;
  });
  return best;
}

void Walls::hit(Slot slot, const Eigen::Vector2d& p) {
  Wall& wall = (*this)[slot];
  const Eigen::Vector2d td = wall.toWall(p);
  const SupportBin& bin = wall.profile.hit(td.x(), td.y());
  wall.hits += 1.0;
  touch(slot);
  const bool is_new = bin.hits() == 1.0 && bin.passed == 0.0;
  if (is_new && freed_.count(freedPlace(p)) > 0 && !standsBeside(slot, p)) {
    wall.profile.pass(td.x(), kRaysOfFreed);
  }
}

bool Walls::standsBeside(Slot slot, const Eigen::Vector2d& p) const {
  const std::vector<Slot>& near = index_.at(WallIndex::cellOf(p));
  return std::any_of(near.begin(), near.end(), [&](Slot other) {
    const Wall& wall = (*this)[other];
    const Eigen::Vector2d td = wall.toWall(p);
    const int i = SupportProfile::binOf(td.x());
    return other != slot && std::abs(wall.offLine(td)) <= kBeside && wall.profile.contains(i) &&
           wall.profile.occupied(i);
  });
}

bool Walls::prune(Slot slot) {
  Wall& wall = (*this)[slot];
  for (const int i : wall.profile.prune()) {
    freed_.insert(freedPlace(wall.onLine((i + 0.5) * SupportProfile::kBinLength)));
  }
  return !wall.profile.empty();
}

void Walls::touch(Slot slot) {
  Wall& wall = (*this)[slot];
  if (wall.touched) return;
  wall.touched = true;
  touched_.push_back(slot);
}

}  // namespace cca
