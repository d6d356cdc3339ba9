// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/global_planner.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/navigation/beam.hpp"

namespace cca {
namespace {

constexpr int kFrontierExtent = 40;  // cells: longer frontiers are several
// m, into the unknown: what a view point is to see. Half a metre lets the robot peek around a
// corner and decide anew, time and again: eight worlds took 3 % more to 90 % coverage, and no less
// to 99 %.
constexpr double kBehindFrontier = 2.0;
// A frontier of fewer cells than this is a rest: it waits until nothing larger is left, unless it
// can be looked at in passing.
constexpr std::size_t kRest = 25;
constexpr double kInPassing = 2.5;  // m
// m^2, of gain exp(-0.2 way): a frontier that promises this is driven into. With 3 there is less
// way to 90 % coverage and more to 99 %, with 8 the reverse.
constexpr double kWorthEntering = 6.5;
constexpr int kEntryAside = 12;              // cells, from a frontier's middle
constexpr double kViewShare = 0.9;           // of the laser's range: beams lie too far apart beyond
constexpr double kGainRange = 3.0;           // m, around what is to be seen
constexpr std::size_t kMostViewPoints = 60;  // of a decision; the nearest frontiers
constexpr double kReconsiderAfter = 0.3;     // m driven
constexpr std::size_t kWorthReconsidering = 20;  // cells newly seen
constexpr double kLongestStep = 0.5;             // m, between scans; a farther one is a jump
constexpr double kPassed = 0.1;                  // m, of a corner
constexpr double kMuchShorter = 0.5;             // m

bool isInside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace

GlobalPlanner::GlobalPlanner(const GlobalPlannerParameters& parameters)
    : parameters_(parameters),
      strategy_(strategyNamed(parameters.strategy)),
      space_(parameters.clearance, grid_.resolution()),
      view_tour_(parameters.tour) {}

void GlobalPlanner::observe(const Scan& scan, const Eigen::Vector2d& robot_map) {
  learnRange(scan);
  grid_.insert(scan);
  takeChanges();
  if (!isOnGrid(robot_map)) return;
  notePassage(robot_map);
  scanned_.add(grid_.cellOf(robot_map), scan);
}

void GlobalPlanner::notePassage(const Eigen::Vector2d& robot_map) {
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

bool GlobalPlanner::isOnGrid(const Eigen::Vector2d& p_map) const {
  return p_map.allFinite() && p_map.cwiseAbs().maxCoeff() < grid_.resolution() * kFarthestCell;
}

const Plan& GlobalPlanner::update(const Scan& scan, const Eigen::Vector2d& robot_map) {
  observe(scan, robot_map);
  if (!isOnGrid(robot_map) || grid_.revealed() == 0) return plan_;
  // What stands beside a laser of less than 360 degrees is not known before it has turned once.
  if (!has_looked_around_) has_looked_around_ = scanned_.contains(grid_.cellOf(robot_map));
  if (!has_looked_around_) {
    lookAround();
    return plan_;
  }
  if (!goalStands() || isTimeToReconsider(robot_map)) {
    decide(robot_map);
  } else {
    advance(robot_map);
    if (!pathStands()) replan(robot_map);
  }
  return plan_;
}

void GlobalPlanner::takeChanges() {
  space_.update(grid_, grid_.changed());
  frontier_cells_.update(grid_, grid_.changed());
}

void GlobalPlanner::seed(const std::vector<Cell>& cells, CellState state) {
  for (const Cell c : cells) grid_.set(c, state);
  takeChanges();
}

void GlobalPlanner::learnRange(const Scan& scan) {
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double seen = scan.freeRange(beam);
    if (isReturn(seen)) laser_range_ = std::max(laser_range_, seen);
  }
}

double GlobalPlanner::reach() const { return (is_last_look_ ? 1.0 : kViewShare) * laser_range_; }

bool GlobalPlanner::goalStands() const {
  if (!goal_ || grid_.at(goal_->target) != CellState::kUnknown) return false;
  return !scanned_.contains(goal_->cell);
}

// The first leg, which begins where the robot is, counts only where the robot stands clear itself.
bool GlobalPlanner::pathStands() const {
  const double r = grid_.resolution();
  const bool stands_clear = space_.isTraversable(grid_.cellOf(plan_.path.front()));
  for (std::size_t i = stands_clear ? 1 : 2; i < plan_.path.size(); ++i) {
    if (!isClearLine(space_, plan_.path[i - 1] / r, plan_.path[i] / r)) return false;
  }
  return true;
}

// The path begins at the robot, and corners are left out as soon as the next one is in clear line.
void GlobalPlanner::advance(const Eigen::Vector2d& robot_map) {
  std::vector<Eigen::Vector2d>& path = plan_.path;
  path.front() = robot_map;
  const double r = grid_.resolution();
  while (path.size() > 2 && ((path[1] - robot_map).norm() < kPassed ||
                             isClearLine(space_, robot_map / r, path[2] / r))) {
    path.erase(path.begin() + 1);
  }
}

// Another way to the same goal; another goal only where there is no way left.
void GlobalPlanner::replan(const Eigen::Vector2d& robot_map) {
  field_.search(space_, grid_.resolution(), grid_.cellOf(robot_map), DistanceField::kUnreached,
                goal_->cell);
  plan_.path = shortestPath(space_, grid_.resolution(), field_, goal_->cell);
  if (plan_.path.empty()) {
    if (aside_.noteLostWay(goal_->target)) setGoalAside();
    decide(robot_map);
  } else if (plan_.path.size() == 1) {
    plan_.path.insert(plan_.path.begin(), robot_map);
  }
}

// A decision is made again only after something new was seen: what was the best stays the best
// otherwise, and a finite place cannot be circled for ever.
bool GlobalPlanner::isTimeToReconsider(const Eigen::Vector2d& robot_map) const {
  return strategy_ == Strategy::kViewTour && (robot_map - decided_at_).norm() > kReconsiderAfter &&
         grid_.revealed() > revealed_then_ + kWorthReconsidering;
}

void GlobalPlanner::decide(const Eigen::Vector2d& robot_map) {
  if (goal_ && grid_.at(goal_->target) == CellState::kUnknown && scanned_.contains(goal_->cell)) {
    setGoalAside();  // there, and nothing seen
  }
  decided_at_ = robot_map;
  revealed_then_ = grid_.revealed();
  plan_ = {};
  field_.search(space_, grid_.resolution(), grid_.cellOf(robot_map));
  // Before it ends, what was given up gets another chance, and then what is hard to see.
  const auto present = goal_;
  for (const bool is_last_look : {false, true}) {
    is_last_look_ = is_last_look;
    goal_ = present;
    findViewPoints();
    keepPresentGoal();
    if (view_points_.empty() && recall(robot_map)) findViewPoints();
    if (!view_points_.empty()) break;
  }
  while (const auto chosen = choose()) {
    plan_.path = shortestPath(space_, grid_.resolution(), field_, chosen->cell);
    if (!goal_ || goal_->target != chosen->target) ++goals_;
    goal_ = chosen;
    plan_.look_at = grid_.centreOf(chosen->target);
    if (!plan_.path.empty()) {
      if (plan_.path.size() == 1) plan_.path.insert(plan_.path.begin(), robot_map);
      plan_.reason = "to see what is behind a frontier";
      return;
    }
    setGoalAside();
    for (auto* views : {&view_points_, &entries_}) {
      const auto of_it = [&](const ViewPoint& v) { return v.target == chosen->target; };
      views->erase(std::remove_if(views->begin(), views->end(), of_it), views->end());
    }
  }
  goal_.reset();
  if (!scanned_.contains(grid_.cellOf(robot_map))) {
    lookAround();
    return;
  }
  plan_.finished = true;
  plan_.reason = field_.isStarted()
                     ? "no reachable frontier of useful size is left"
                     : "the robot stands where nothing around it is known to be free";
}

void GlobalPlanner::lookAround() {
  plan_ = {};
  plan_.look_around = true;
  plan_.reason = "to look around";
}

std::optional<ViewPoint> GlobalPlanner::choose() {
  if (strategy_ != Strategy::kViewTour) {
    const auto best = selectGoal(strategy_, view_points_);
    return best ? std::optional<ViewPoint>(view_points_[*best]) : std::nullopt;
  }
  const auto entry = selectGoal(Strategy::kGainDistance, entries_);
  if (entry && discountedGain(entries_[*entry]) >= kWorthEntering) return entries_[*entry];
  const auto present = goal_ ? std::optional<Cell>(goal_->target) : std::nullopt;
  const auto stop = view_tour_.choose(grid_, space_, view_points_, reach(), present, only_rests_);
  return stop ? std::optional<ViewPoint>(view_points_[*stop]) : std::nullopt;
}

void GlobalPlanner::findViewPoints() {
  struct Candidate {
    double distance;
    const Frontier* frontier;
  };
  std::vector<Candidate> candidates;
  const Cell here = grid_.cellOf(decided_at_);
  const std::vector<Frontier> frontiers = frontier_cells_.frontiers(kFrontierExtent);
  for (const Frontier& frontier : frontiers) {
    if (frontier.cells.size() < (is_last_look_ ? kRest : parameters_.smallest_frontier)) continue;
    const Cell m = frontier.middle;
    const double known_way = field_.distanceTo(m);
    const double line = std::hypot(m.x - here.x, m.y - here.y) * grid_.resolution();
    candidates.push_back({known_way < DistanceField::kUnreached ? known_way : line, &frontier});
  }
  if (candidates.size() > kMostViewPoints) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.distance < b.distance; });
  }
  view_points_.clear();
  entries_.clear();
  std::vector<ViewPoint> rests;
  for (const Candidate& candidate : candidates) {
    if (view_points_.size() + rests.size() >= kMostViewPoints) break;
    const auto view_point = viewOf(*candidate.frontier);
    if (!view_point) continue;
    if (candidate.frontier->cells.size() < kRest) {
      rests.push_back(*view_point);
      continue;
    }
    view_points_.push_back(*view_point);
    if (strategy_ != Strategy::kViewTour) continue;
    if (const auto entry = entryAt(candidate.frontier->middle)) {
      entries_.push_back({*entry, view_point->target, field_.distanceTo(*entry), view_point->gain});
    }
  }
  only_rests_ = view_points_.empty();
  for (const ViewPoint& rest : rests) {
    if (only_rests_ || rest.distance < kInPassing) view_points_.push_back(rest);
  }
}

// What lies two metres behind a frontier may be inside a wall, or seen from nowhere. Once that has
// been set aside, or nothing else is left to see, the frontier gets another chance with a nearer
// target.
std::optional<ViewPoint> GlobalPlanner::viewOf(const Frontier& frontier) const {
  for (const double depth : {kBehindFrontier, 0.25 * kBehindFrontier, 0.0}) {
    const Cell target = cellBehind(grid_, frontier, depth);
    if (!isWithinLimits(target) || aside_.contains(target, grid_.revealed())) continue;
    const double gain = unknownAreaInView(grid_, target, kGainRange);
    if (gain >= parameters_.smallest_gain) {
      auto view_point = nearestViewPoint(grid_, space_, field_, scanned_, target, reach());
      if (view_point && isWithinLimits(view_point->cell)) {
        view_point->gain = gain;
        return view_point;
      }
    }
    if (!is_last_look_) break;
  }
  return {};
}

// Where the robot would cross a frontier.
std::optional<Cell> GlobalPlanner::entryAt(Cell middle) const {
  Cell entry;
  if (!nearestTraversable(space_, middle, kEntryAside, entry)) return {};
  const bool is_reached = field_.distanceTo(entry) < DistanceField::kUnreached;
  if (!is_reached || scanned_.contains(entry) || !isWithinLimits(entry)) return {};
  return entry;
}

// Frontiers are grouped anew at each decision, so the present goal may have got another target in
// the middle of much the same frontier. It stays itself while that has not been seen.
void GlobalPlanner::keepPresentGoal() {
  if (!goal_ || grid_.at(goal_->target) != CellState::kUnknown) {
    goal_.reset();
    return;
  }
  constexpr double kMuchTheSame = 20.0;  // cells
  auto view_point = nearestViewPoint(grid_, space_, field_, scanned_, goal_->target, reach());
  if (!view_point || !isWithinLimits(view_point->cell)) {
    goal_.reset();
    return;
  }
  // From where to see it is not changed for a trifle, either.
  const double way = field_.distanceTo(goal_->cell);
  if (way < view_point->distance + kMuchShorter && isInView(grid_, goal_->cell, goal_->target)) {
    view_point->cell = goal_->cell;
    view_point->distance = way;
  }
  view_point->gain = unknownAreaInView(grid_, goal_->target, kGainRange);
  double nearest = kMuchTheSame;
  ViewPoint* same = nullptr;
  for (ViewPoint& v : view_points_) {
    const double off = std::hypot(v.target.x - goal_->target.x, v.target.y - goal_->target.y);
    if (off >= nearest) continue;
    nearest = off;
    same = &v;
  }
  if (same) {
    *same = *view_point;
  } else {
    view_points_.push_back(*view_point);
  }
}

void GlobalPlanner::setGoalAside() {
  if (goal_) aside_.add(goal_->target, grid_.revealed());
  goal_.reset();
}

void GlobalPlanner::bar(const std::vector<Eigen::Vector2d>& way) {
  barred_.bar(way, grid_.resolution(), space_);
}

// Where there is no other way, the place stays open for the goals behind it: each is another try.
bool GlobalPlanner::goAround(const std::vector<Eigen::Vector2d>& way) {
  if (!goal_ || !last_place_) return false;
  bar(way);
  field_.search(space_, grid_.resolution(), grid_.cellOf(*last_place_));
  if (!nearestViewPoint(grid_, space_, field_, scanned_, goal_->target, reach())) {
    barred_.openLast(space_);
    return false;
  }
  if (aside_.noteLostWay(goal_->target)) setGoalAside();
  goal_.reset();
  return true;
}

// Goals that were set aside, and ways.
bool GlobalPlanner::recall(const Eigen::Vector2d& robot_map) {
  const bool any_goals = aside_.recall(grid_.revealed());
  const bool any_ways = barred_.openAll(space_);
  if (any_ways) field_.search(space_, grid_.resolution(), grid_.cellOf(robot_map));
  return any_goals || any_ways;
}

void GlobalPlanner::noteArrival() {
  if (goal_) scanned_.addAll(goal_->cell);
}

void GlobalPlanner::noteLookAround(const Eigen::Vector2d& robot_map) {
  if (isOnGrid(robot_map)) scanned_.addAll(grid_.cellOf(robot_map));
}

bool GlobalPlanner::isWithinLimits(Cell c) const {
  return parameters_.limits.size() < 3 || isInside(parameters_.limits, grid_.centreOf(c));
}

std::vector<Eigen::Vector2d> GlobalPlanner::pathTo(const Eigen::Vector2d& robot_map,
                                                   const Eigen::Vector2d& goal_map) {
  if (!isOnGrid(robot_map) || !isOnGrid(goal_map)) return {};
  constexpr int kNearEnough = 10;  // cells
  std::vector<Eigen::Vector2d> path;
  do {
    Cell goal;
    if (!nearestTraversable(space_, grid_.cellOf(goal_map), kNearEnough, goal)) continue;
    field_.search(space_, grid_.resolution(), grid_.cellOf(robot_map), DistanceField::kUnreached,
                  goal);
    path = shortestPath(space_, grid_.resolution(), field_, goal);
  } while (path.empty() && barred_.openAll(space_));
  return path;
}

}  // namespace cca
