// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/last_look.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace cca {
namespace {

constexpr int kLooksAtATime = 60;  // some 10 ms, 30 in a wide hall

/// Cells of a block that the robot can reach: the first one, and beside obstacles, where a few
/// centimetres count, also the last one.
std::vector<Cell> placesIn(const KnownPlace& place, Cell block) {
  constexpr unsigned kAll = 0xFFFF;
  const unsigned traversable = place.space().traversableCells(block);
  std::vector<Cell> cells;
  FreeSpace::eachCell(block, traversable, [&](Cell c) {
    if (place.ways().isReached(c)) cells.push_back(c);
  });
  if (cells.size() > 1) cells.erase(cells.begin() + 1, cells.end() - (traversable != kAll));
  return cells;
}

}  // namespace

void LastLook::begin(const KnownPlace& place) {
  unseen_ = place.openings(smallest_frontier_).cells();
  blocks_.clear();
  found_.clear();
  is_block_ = TiledGrid<char>{0};
  is_under_way_ = !unseen_.empty();
}

std::optional<ViewPoint> LastLook::next(const KnownPlace& place, Strategy strategy,
                                        const Filter& filter) {
  if (!is_under_way_ && found_.empty()) return {};
  looks_left_ = kLooksAtATime;
  openings_ = place.openings(smallest_frontier_);
  findPlaces(place);
  askPlaces(place);
  is_under_way_ = !unseen_.empty() || !blocks_.empty();
  return is_under_way_ ? std::nullopt : choose(place, strategy, filter);
}

std::string LastLook::whatIsLeft() const {
  const auto ratio = [](const ViewPoint& view) { return view.expected / (view.distance + 1e-9); };
  const auto best =
      std::max_element(found_.begin(), found_.end(),
                       [&](const auto& a, const auto& b) { return ratio(a) < ratio(b); });
  if (best == found_.end()) return "no reachable frontier of useful size is left";
  std::ostringstream text;
  text.precision(2);
  text << "nothing that is left is worth its way, at best some " << best->expected << " m^2 for "
       << best->distance << " m";
  return text.str();
}

void LastLook::findPlaces(const KnownPlace& place) {
  for (; !unseen_.empty() && looks_left_ > 0; unseen_.pop_back(), --looks_left_) {
    eachBlockInView(place.grid(), unseen_.back(), place.laserRange(), [&](Cell block) {
      if (std::exchange(is_block_[block], 1)) return;
      blocks_.push_back(block);
    });
  }
}

void LastLook::askPlaces(const KnownPlace& place) {
  for (; unseen_.empty() && !blocks_.empty() && looks_left_ > 0; blocks_.pop_back()) {
    if (place.scanned().containsBlock(blocks_.back())) continue;
    std::optional<ViewPoint> best;
    for (const Cell c : placesIn(place, blocks_.back())) {
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
  const auto isWorthIt = [&](const ViewPoint& view) {
    return worth_ * view.expected > view.distance;
  };
  while (true) {
    const auto end = std::stable_partition(found_.begin(), found_.end(), isWorthIt);
    const auto best = selectGoal(strategy, {found_.begin(), end});
    if (!best) break;
    is_under_way_ = looks_left_ <= 0;
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
  --looks_left_;
  ViewPoint view = viewFrom(place.grid(), cell, place.laserRange(), openings_);
  view.distance = place.ways().distanceTo(cell);
  return view;
}

void UnpaidWay::note(const Eigen::Vector2d& robot_map, double seen) {
  const double way = last_place_ ? (robot_map - *last_place_).norm() : 0.0;
  metres_ = std::max(0.0, metres_ + way - worth_ * std::max(0.0, seen - seen_));
  last_place_ = robot_map;
  seen_ = seen;
}

}  // namespace cca
