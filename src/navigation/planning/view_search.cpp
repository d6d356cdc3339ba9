// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/view_search.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

namespace cca {
namespace {

constexpr int kLook = 16;                  // what a look takes; 1 where no frontier is in reach
constexpr int kLooksAtATime = 60 * kLook;  // some 10 ms, 20 in a wide hall
constexpr std::size_t kWorthAskingAgain = 200;  // cells newly seen: half a square metre
constexpr double kMostExpected = 10.0;          // m^2, that any place may show
constexpr double kMostDetour = 1.0;             // m, for what is seen in passing
constexpr double kNone = -std::numeric_limits<double>::infinity();

/// m^2 / m, what is expected for the way: a place at hand is a metre off, too.
double perMetre(const ViewPoint& view) { return view.expected / (1.0 + view.distance); }

/// A cell of a block that the robot can reach, the last one.
std::optional<Cell> reachedCell(const PlanningScene& scene, Cell block) {
  std::optional<Cell> reached;
  FreeSpace::eachCell(block, scene.space().traversableCells(block), [&](Cell c) {
    if (scene.distances().isReached(c)) reached = c;
  });
  return reached;
}

}  // namespace

std::optional<ViewPoint> ViewSearch::next(const PlanningScene& scene, Strategy strategy,
                                          const Filter& filter) {
  looks_left_ = kLooksAtATime;
  frontier_cells_ = scene.world().usefulFrontierCells(smallest_frontier_);
  for (ViewPoint& view : viewpoints_) view.distance = scene.distances().distanceTo(view.cell);
  double best = 0.0;
  for (const ViewPoint& view : viewpoints_) {
    if (isWorthItsWay(view, filter)) best = std::max(best, scoreOf(Strategy::kViewTour, view));
  }
  const bool asks_all = strategy != Strategy::kViewTour;
  findCandidates(scene);
  evaluateCandidates(scene, asks_all ? 0.0 : best);
  if (is_under_way_) return {};
  const auto chosen = choose(scene, strategy, filter);
  const std::size_t revealed = scene.grid().revealed();
  if (chosen || is_under_way_) return chosen;
  is_under_way_ = canBeBetter(0.0);  // than what proved worse than it had seemed
  if (is_under_way_ || revealed <= revealed_then_ + kWorthAskingAgain) return {};
  forget();
  is_under_way_ = true;
  revealed_then_ = revealed;
  apart_ = 1;
  return {};
}

bool ViewSearch::isWorthItsWay(const ViewPoint& view, const Filter& filter) const {
  return worth_ * view.expected > view.distance && filter(view);
}

bool ViewSearch::canBeSeen(const PlanningScene& scene, Cell target) const {
  return std::any_of(viewpoints_.begin(), viewpoints_.end(), [&](const ViewPoint& view) {
    return scene.distances().isReached(view.cell) &&
           isInView(scene.grid(), view.cell, target, scene.world().laserRange());
  });
}

std::vector<ViewPoint> ViewSearch::nextBest(Strategy strategy, const Filter& filter,
                                            std::vector<ViewPoint> chosen, std::size_t most) const {
  std::vector<ViewPoint> others;
  while (others.size() < most) {
    const ViewPoint* best = nullptr;
    for (const ViewPoint& view : viewpoints_) {
      const bool is_worse = best && scoreOf(strategy, view) <= scoreOf(strategy, *best);
      if (is_worse || !isWorthItsWay(view, filter)) continue;
      const bool is_shown = std::any_of(chosen.begin(), chosen.end(), [&](const ViewPoint& other) {
        return distanceBetween(view.target, other.target) < WorldModel::kFrontierExtent;
      });
      if (!is_shown) best = &view;
    }
    if (!best) break;
    others.push_back(*best);
    chosen.push_back(*best);
  }
  return others;
}

std::string ViewSearch::whatIsLeft() const {
  const ViewPoint* best = nullptr;
  for (const ViewPoint& view : viewpoints_) {
    const bool is_refused = worth_ * view.expected > view.distance;
    if (is_refused || view.distance == DistanceField::kUnreached) continue;
    if (!best || perMetre(view) > perMetre(*best)) best = &view;
  }
  if (!best) return "no reachable frontier of useful size is left";
  std::ostringstream text;
  text.precision(2);
  text << "nothing that is left is worth its way, at best some " << best->expected << " m^2 for "
       << best->distance << " m";
  return text.str();
}

void ViewSearch::findCandidates(const PlanningScene& scene) {
  const auto down = [this](int k) { return k - (k % apart_ + apart_) % apart_; };
  const Cell low = FreeSpace::blockOf(scene.grid().lowest());
  const Cell high = FreeSpace::blockOf(scene.grid().highest());
  for (int y = down(low.y); y <= high.y; y += apart_) {
    for (int x = down(low.x); x <= high.x; x += apart_) {
      if (has_candidate_.at({x, y})) continue;
      const auto cell = reachedCell(scene, {x, y});
      if (!cell) continue;
      has_candidate_[{x, y}] = 1;
      candidates_.push_back({*cell, *cell});
    }
  }
  for (ViewPoint& view : candidates_) {
    view.distance = scene.distances().distanceTo(view.cell);
    view.expected = kMostExpected;
  }
  std::stable_sort(candidates_.begin(), candidates_.end(),
                   [](const ViewPoint& a, const ViewPoint& b) { return a.distance > b.distance; });
}

// The nearest candidate.
bool ViewSearch::canBeBetter(double best) const {
  return !candidates_.empty() && scoreOf(Strategy::kViewTour, candidates_.back()) > best;
}

void ViewSearch::evaluateCandidates(const PlanningScene& scene, double best) {
  for (; canBeBetter(best) && looks_left_ > 0; candidates_.pop_back()) {
    if (scene.isExhausted(candidates_.back().cell)) continue;
    const ViewPoint view = evaluateViewpoint(scene, candidates_.back().cell);
    if (view.gain >= smallest_gain_) viewpoints_.push_back(view);
  }
  is_under_way_ = canBeBetter(best);
}

// Only the viewpoint that seems best is evaluated again, until one is as good as it seemed.
std::optional<ViewPoint> ViewSearch::choose(const PlanningScene& scene, Strategy strategy,
                                            const Filter& filter) {
  const auto shows_nothing = [&](const ViewPoint& view) {
    return view.gain < smallest_gain_ || scene.isExhausted(view.cell);
  };
  viewpoints_.erase(std::remove_if(viewpoints_.begin(), viewpoints_.end(), shows_nothing),
                    viewpoints_.end());
  const auto score = [&](const ViewPoint& view) {
    return isWorthItsWay(view, filter) ? scoreOf(strategy, view) : kNone;
  };
  std::vector<double> scores;
  for (const ViewPoint& view : viewpoints_) scores.push_back(score(view));
  while (!viewpoints_.empty()) {
    const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
    if (scores[static_cast<std::size_t>(best)] == kNone) break;
    ViewPoint& view = viewpoints_[static_cast<std::size_t>(best)];
    is_under_way_ = looks_left_ <= 0;
    if (is_under_way_) break;
    const ViewPoint now = evaluateViewpoint(scene, view.cell);
    const bool is_as_good = now.gain >= view.gain;
    view = now;
    double& its_score = scores[static_cast<std::size_t>(best)];
    its_score = score(now);
    if (now.gain < smallest_gain_) {
      viewpoints_.erase(viewpoints_.begin() + best);
      scores.erase(scores.begin() + best);
    } else if (is_as_good && its_score != kNone) {
      return now;
    }
  }
  return {};
}

std::optional<ViewPoint> ViewSearch::onTheWay(const PlanningScene& scene, const Filter& filter,
                                              const ViewPoint& goal) {
  const auto detourBy = [&](const ViewPoint& view) {
    const double line = distanceBetween(view.cell, goal.cell) * scene.grid().resolution();
    return std::max(0.0, view.distance + line - goal.distance);
  };
  const auto isOnTheWay = [&](const ViewPoint& view) {
    return view.gain >= smallest_gain_ && view.distance < goal.distance &&
           detourBy(view) <= kMostDetour && isWorthItsWay(view, filter) &&
           !isInView(scene.grid(), goal.cell, view.target, scene.world().laserRange());
  };
  std::vector<std::pair<double, ViewPoint*>> candidates;
  for (ViewPoint& view : viewpoints_) {
    if (isOnTheWay(view))
      candidates.emplace_back((kShortestWay + detourBy(view)) / view.expected, &view);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& candidate : candidates) {
    if (looks_left_ <= 0) break;
    ViewPoint& view = *candidate.second;
    view = evaluateViewpoint(scene, view.cell);
    if (isOnTheWay(view)) return view;
  }
  return {};
}

ViewPoint ViewSearch::evaluateViewpoint(const PlanningScene& scene, Cell cell) {
  const double range = scene.world().laserRange() / scene.grid().resolution();
  const bool is_in_reach =
      std::any_of(frontier_cells_.cells().begin(), frontier_cells_.cells().end(),
                  [&](Cell opening) { return distanceBetween(opening, cell) <= range; });
  looks_left_ -= is_in_reach ? kLook : 1;
  ViewPoint view{cell, cell};
  if (is_in_reach) view = viewFrom(scene.grid(), cell, scene.world().laserRange(), frontier_cells_);
  view.distance = scene.distances().distanceTo(cell);
  return view;
}

}  // namespace cca
