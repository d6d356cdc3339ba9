// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/frontier_views.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

// m, into the unknown: what a view point is to see. Half a metre lets the robot peek around a
// corner and decide anew, time and again: eight worlds took 3 % more to 90 % coverage, and no less
// to 99 %.
constexpr double kBehindFrontier = 2.0;
// A frontier of fewer cells than this is a rest.
constexpr std::size_t kRest = 25;
constexpr double kInPassing = 2.5;           // m
constexpr int kEntryAside = 12;              // cells, from a frontier's middle
constexpr double kViewShare = 0.9;           // of the laser's range: beams lie too far apart beyond
constexpr double kGainRange = 3.0;           // m, around what is to be seen
constexpr std::size_t kMostViewPoints = 60;  // of the nearest frontiers
constexpr double kMuchShorter = 0.5;         // m
constexpr double kMuchTheSame = 20.0;        // cells

bool isInside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool isRest(const Frontier& frontier) { return frontier.cells.size() < kRest; }

}  // namespace

double FrontierViews::reach(const KnownPlace& place) const {
  return kViewShare * place.laserRange();
}

bool FrontierViews::isWithinLimits(const KnownPlace& place, Cell c) const {
  return limits_.size() < 3 || isInside(limits_, place.grid().centreOf(c));
}

void FrontierViews::find(const KnownPlace& place, Cell here) {
  view_points_.clear();
  entries_.clear();
  const std::vector<Frontier> frontiers = nearestFrontiers(place, here);
  for (const Frontier& frontier : frontiers) {
    if (isRest(frontier) || view_points_.size() >= kMostViewPoints) continue;
    const auto view_point = viewOf(place, frontier);
    if (!view_point) continue;
    view_points_.push_back(*view_point);
    if (const auto entry = entryAt(place, frontier.middle)) {
      entries_.push_back(
          {*entry, view_point->target, place.ways().distanceTo(*entry), view_point->gain});
    }
  }
  if (view_points_.empty()) return;
  const double farthest = (kInPassing + reach(place) + kBehindFrontier) / place.grid().resolution();
  for (const Frontier& frontier : frontiers) {
    const bool is_near = distanceBetween(frontier.middle, here) < farthest;
    if (!isRest(frontier) || !is_near || view_points_.size() >= kMostViewPoints) continue;
    const auto view_point = viewOf(place, frontier);
    if (view_point && view_point->distance < kInPassing) view_points_.push_back(*view_point);
  }
}

// In the order of the grid's history where all can be looked at, else the nearest first.
std::vector<Frontier> FrontierViews::nearestFrontiers(const KnownPlace& place, Cell here) const {
  struct Candidate {
    double distance;
    Frontier frontier;
  };
  std::vector<Candidate> candidates;
  for (Frontier& frontier : place.frontiers()) {
    if (frontier.cells.size() < smallest_frontier_) continue;
    const double known_way = place.ways().distanceTo(frontier.middle);
    const double line = distanceBetween(frontier.middle, here) * place.grid().resolution();
    const double distance = known_way < DistanceField::kUnreached ? known_way : line;
    candidates.push_back({distance, std::move(frontier)});
  }
  if (candidates.size() > kMostViewPoints) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.distance < b.distance; });
  }
  std::vector<Frontier> nearest;
  for (Candidate& candidate : candidates) nearest.push_back(std::move(candidate.frontier));
  return nearest;
}

std::optional<ViewPoint> FrontierViews::viewOf(const KnownPlace& place, Cell target) const {
  const auto view_point = nearestViewPoint(place.grid(), place.space(), place.ways(),
                                           place.scanned(), target, reach(place));
  return view_point && isWithinLimits(place, view_point->cell) ? view_point : std::nullopt;
}

// What lies two metres behind a frontier may be inside a wall. Once that has been set aside, the
// frontier gets another chance with a nearer target.
std::optional<ViewPoint> FrontierViews::viewOf(const KnownPlace& place,
                                               const Frontier& frontier) const {
  const ExplorationGrid& grid = place.grid();
  for (const double depth : {kBehindFrontier, 0.25 * kBehindFrontier, 0.0}) {
    const Cell target = cellBehind(grid, frontier, depth);
    if (!isWithinLimits(place, target) || place.isAside(target)) continue;
    const double gain = unknownAreaInView(grid, target, kGainRange);
    if (gain < smallest_gain_) break;
    auto view_point = viewOf(place, target);
    if (view_point) view_point->gain = gain;
    return view_point;
  }
  return {};
}

// Where the robot would cross a frontier.
std::optional<Cell> FrontierViews::entryAt(const KnownPlace& place, Cell middle) const {
  Cell entry;
  if (!nearestTraversable(place.space(), middle, kEntryAside, entry)) return {};
  const bool is_known = !place.ways().isReached(entry) || place.scanned().contains(entry);
  if (is_known || !isWithinLimits(place, entry)) return {};
  return entry;
}

bool FrontierViews::keep(const KnownPlace& place, const ViewPoint& goal) {
  auto view_point = viewOf(place, goal.target);
  if (!view_point) return false;
  // From where to see it is not changed for a trifle, either.
  const double way = place.ways().distanceTo(goal.cell);
  if (way < view_point->distance + kMuchShorter && isInView(place.grid(), goal.cell, goal.target)) {
    view_point->cell = goal.cell;
    view_point->distance = way;
  }
  view_point->gain = unknownAreaInView(place.grid(), goal.target, kGainRange);
  double nearest = kMuchTheSame;
  ViewPoint* same = nullptr;
  for (ViewPoint& v : view_points_) {
    const double off = distanceBetween(v.target, goal.target);
    if (off >= nearest) continue;
    nearest = off;
    same = &v;
  }
  if (same) {
    *same = *view_point;
  } else {
    view_points_.push_back(*view_point);
  }
  return true;
}

}  // namespace cca
