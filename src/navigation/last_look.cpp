// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/last_look.hpp"

#include <algorithm>
#include <cstdlib>

namespace cca {
namespace {

constexpr int kPlacesAtATime = 60;  // some 10 ms, 30 in a wide hall
constexpr int kAround = 10;         // cells

/// Cells of a block that the robot can reach: the first one, and beside obstacles, where a few
/// centimetres count, also the last one.
std::vector<Cell> placesIn(const KnownPlace& place, Cell block) {
  constexpr unsigned kAll = 0xFFFF;
  const unsigned traversable = place.space().traversableCells(block);
  std::vector<Cell> cells;
  for (int k = 0; traversable >> k; ++k) {
    const Cell c{FreeSpace::kBlock * block.x + k % FreeSpace::kBlock,
                 FreeSpace::kBlock * block.y + k / FreeSpace::kBlock};
    if ((traversable >> k & 1) && place.ways().isReached(c)) cells.push_back(c);
  }
  if (cells.size() > 1) cells.erase(cells.begin() + 1, cells.end() - (traversable != kAll));
  return cells;
}

}  // namespace

void LastLook::begin(const KnownPlace& place) {
  found_.clear();
  first_ = block_ = FreeSpace::blockOf(place.grid().lowest());
  last_ = FreeSpace::blockOf(place.grid().highest());
  is_under_way_ = true;
}

std::optional<ViewPoint> LastLook::next(KnownPlace& place, Strategy strategy,
                                        const Filter& filter) {
  places_left_ = kPlacesAtATime;
  markFrontiers(place);
  goThroughPlaces(place);
  return is_under_way_ ? std::nullopt : choose(place, strategy, filter);
}

void LastLook::drop(Cell place) {
  const auto is_around = [&](const ViewPoint& view) {
    return std::max(std::abs(view.cell.x - place.x), std::abs(view.cell.y - place.y)) <= kAround;
  };
  found_.erase(std::remove_if(found_.begin(), found_.end(), is_around), found_.end());
}

void LastLook::markFrontiers(KnownPlace& place) {
  ++call_;
  for (const Frontier& frontier : place.frontiers()) {
    if (frontier.cells.size() < smallest_frontier_) continue;
    for (const Cell c : frontier.cells) frontier_cells_[c] = call_;
  }
}

void LastLook::goThroughPlaces(const KnownPlace& place) {
  for (; is_under_way_ && places_left_ > 0; ++block_.x) {
    if (block_.x > last_.x) block_ = {first_.x, block_.y + 1};
    is_under_way_ = block_.y <= last_.y;
    if (!is_under_way_ || place.scanned().containsBlock(block_)) continue;
    std::optional<ViewPoint> best;
    for (const Cell c : placesIn(place, block_)) {
      const ViewPoint view = lookFrom(place, c);
      if (!best || view.gain > best->gain) best = view;
    }
    if (best && best->gain >= smallest_gain_) found_.push_back(*best);
  }
}

// Only the place that seems best is asked again, until one is as good as it seemed.
std::optional<ViewPoint> LastLook::choose(const KnownPlace& place, Strategy strategy,
                                          const Filter& filter) {
  for (ViewPoint& view : found_) view.distance = place.ways().distanceTo(view.cell);
  found_.erase(std::remove_if(found_.begin(), found_.end(),
                              [&](const ViewPoint& view) {
                                return !place.ways().isReached(view.cell) ||
                                       place.scanned().contains(view.cell);
                              }),
               found_.end());
  while (const auto best = selectGoal(strategy, found_)) {
    is_under_way_ = places_left_ <= 0;
    if (is_under_way_) break;
    const auto view = found_.begin() + static_cast<std::ptrdiff_t>(*best);
    const ViewPoint now = lookFrom(place, view->cell);
    if (now.gain < smallest_gain_ || !filter(now)) {
      found_.erase(view);
    } else if (now.gain >= view->gain) {
      return now;
    } else {
      *view = now;
    }
  }
  return {};
}

ViewPoint LastLook::lookFrom(const KnownPlace& place, Cell cell) {
  --places_left_;
  ViewPoint view = viewFrom(place.grid(), cell, place.laserRange(),
                            [&](Cell c) { return frontier_cells_.at(c) == call_; });
  view.distance = place.ways().distanceTo(cell);
  return view;
}

}  // namespace cca
