// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/global_planner.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace cca {
namespace {

constexpr double kReconsiderAfter = 0.5;         // m driven
constexpr std::size_t kWorthReconsidering = 20;  // cells newly seen
constexpr double kPromising = 0.15;              // m^2 that are expected for their way
constexpr double kPassed = 0.1;                  // m, of a corner
constexpr double kLongestInVain = 100.0;         // m, and once around what is known
constexpr std::size_t kMostExplained = 12;       // candidates, as many as a tour has stops

}  // namespace

double Plan::unreachedArea() const {
  double area = 0.0;
  for (const UnreachedPart& part : unreached) area += part.area;
  return area;
}

double Plan::passableArea() const {
  double area = 0.0;
  for (const UnreachedPart& part : unreached) area += part.may_be_passable ? part.area : 0.0;
  return area;
}

GlobalPlanner::GlobalPlanner(const GlobalPlannerParameters& parameters, double clearance,
                             double radius)
    : parameters_(parameters),
      radius_(radius),
      place_(clearance),
      view_search_(parameters.smallest_gain, parameters.smallest_frontier, parameters.worth),
      unpaid_way_(parameters.worth) {}

const Plan& GlobalPlanner::update(const Scan& scan, const Eigen::Vector2d& robot_map,
                                  bool is_placed) {
  if (is_placed) place_.observe(scan, robot_map);
  if (!grid().covers(robot_map) || grid().revealed() == 0) return plan_;
  const double r = grid().resolution();
  unpaid_way_.note(robot_map, static_cast<double>(grid().revealed()) * r * r);
  // What stands beside a laser of less than 360 degrees is not known before it has turned once.
  if (!has_looked_around_) has_looked_around_ = isScanned(robot_map);
  if (!has_looked_around_) {
    lookAround();
    return plan_;
  }
  if (!goalStands() || drivesInVain() || isTimeToReconsider(robot_map)) {
    decide(robot_map);
  } else if (std::exchange(is_corrected_, false)) {
    replan(robot_map);
  } else {
    advance(robot_map);
    if (!pathStands()) replan(robot_map);
  }
  return plan_;
}

bool GlobalPlanner::isScanned(const Eigen::Vector2d& p_map) const {
  return place_.scanned().contains(grid().cellOf(p_map));
}

bool GlobalPlanner::isGoalUnseen() const { return goal_ && place_.isUnseen(goal_->target); }

bool GlobalPlanner::goalStands() const {
  return isGoalUnseen() && !place_.scanned().contains(goal_->cell);
}

// The first leg, which begins where the robot is, counts only where the robot stands clear itself.
bool GlobalPlanner::pathStands() const {
  const double r = grid().resolution();
  const bool stands_clear = space().isTraversable(grid().cellOf(plan_.path.front()));
  for (std::size_t i = stands_clear ? 1 : 2; i < plan_.path.size(); ++i) {
    if (!isClearLine(space(), plan_.path[i - 1] / r, plan_.path[i] / r)) return false;
  }
  return true;
}

// The path begins at the robot, and corners are left out as soon as the next one is in clear line.
void GlobalPlanner::advance(const Eigen::Vector2d& robot_map) {
  std::vector<Eigen::Vector2d>& path = plan_.path;
  path.front() = robot_map;
  const double r = grid().resolution();
  while (path.size() > 2 && ((path[1] - robot_map).norm() < kPassed ||
                             isClearLine(space(), robot_map / r, path[2] / r))) {
    path.erase(path.begin() + 1);
  }
}

// Another way to the same goal; another goal only where there is no way left.
void GlobalPlanner::replan(const Eigen::Vector2d& robot_map) {
  place_.findWays(robot_map, goal_->cell);
  if (!takeWayTo(goal_->cell, robot_map)) {
    if (place_.noteFailure(goal_->target, Failure::kWayLost)) goal_.reset();
    decide(robot_map);
  }
}

bool GlobalPlanner::takeWayTo(Cell goal, const Eigen::Vector2d& robot_map) {
  plan_.path = place_.wayTo(goal);
  if (plan_.path.size() == 1) plan_.path.insert(plan_.path.begin(), robot_map);
  plan_.phase = plan_.path.empty() ? PlanPhase::kUndecided : PlanPhase::kDriving;
  return plan_.phase == PlanPhase::kDriving;
}

// A decision is made again only after something new was seen: what was the best stays the best
// otherwise, and a finite place cannot be circled for ever.
bool GlobalPlanner::isTimeToReconsider(const Eigen::Vector2d& robot_map) const {
  return parameters_.strategy == Strategy::kViewTour &&
         (robot_map - decided_at_).norm() > kReconsiderAfter &&
         grid().revealed() > revealed_then_ + kWorthReconsidering;
}

void GlobalPlanner::decide(const Eigen::Vector2d& robot_map) {
  if (isGoalUnseen() && place_.scanned().contains(goal_->cell)) {
    dropGoal(Failure::kNothingSeen);
  }
  is_corrected_ = false;
  decided_at_ = robot_map;
  revealed_then_ = grid().revealed();
  plan_ = {};
  if (!drivesInVain()) {
    do {
      place_.findWays(robot_map);
      if (driveToFrontier(robot_map) || search(robot_map)) return;
    } while (!place_.isHeld() && place_.open());  // where it is held it gets nowhere from here
  }
  goal_.reset();
  if (!isScanned(robot_map)) {
    lookAround();
    return;
  }
  finish(robot_map);
}

// What was not reached is found out once for what was seen.
void GlobalPlanner::finish(const Eigen::Vector2d& robot_map) {
  plan_.phase = PlanPhase::kFinished;
  place_.findWays(robot_map);
  if (std::exchange(unreached_then_, grid().revealed()) != grid().revealed())
    unreached_ = unreachedParts(place_, robot_map, radius_);
  plan_.unreached = unreached_;
  const auto given_up = whyGivenUp();
  plan_.gave_up = given_up.has_value();
  plan_.reason = given_up.value_or(view_search_.whatIsLeft());
  explain(robot_map, {{}, "", DecisionRule::kNone, {}, {}});
}

// The way there and back between the farthest places of a building is not in vain yet.
bool GlobalPlanner::drivesInVain() const {
  const Cell low = grid().lowest(), high = grid().highest();
  const double around = 2.0 * grid().resolution() * (high.x - low.x + high.y - low.y);
  return unpaid_way_.metres() > kLongestInVain + around;
}

std::optional<std::string> GlobalPlanner::whyGivenUp() const {
  if (drivesInVain()) {
    const auto frontiers = place_.frontiers();
    const auto left = std::count_if(frontiers.begin(), frontiers.end(), [&](const Frontier& f) {
      return f.cells.size() >= parameters_.smallest_frontier;
    });
    return "driving shows hardly anything new any more; " + std::to_string(left) +
           " frontiers are left";
  }
  if (place_.isHeld()) return "the robot does not get to what is left from where it stands";
  if (!place_.ways().isStarted())
    return "the robot stands where nothing around it is known to be free";
  return {};
}

/// A goal that there is no way to is set aside; the next step decides anew.
void GlobalPlanner::driveTo(const ViewPoint& chosen, const Eigen::Vector2d& robot_map,
                            const std::string& reason) {
  if (!goal_ || goal_->target != chosen.target) ++goals_;
  goal_ = chosen;
  plan_.look_at = grid().centreOf(chosen.target);
  plan_.reason = reason;
  if (!takeWayTo(chosen.cell, robot_map)) dropGoal(Failure::kNotReached);
}

bool GlobalPlanner::isWithinLimits(Cell c) const {
  return limits_.size() < 3 || isInside(limits_, grid().centreOf(c));
}

ViewSearch::Filter GlobalPlanner::openOnes() const {
  return [this](const ViewPoint& view) {
    return !place_.isAside(view.target) && isWithinLimits(view.cell) && isWithinLimits(view.target);
  };
}

// By the strategies of others, whose goals are frontiers.
bool GlobalPlanner::driveToFrontier(const Eigen::Vector2d& robot_map) {
  if (parameters_.strategy == Strategy::kViewTour) return false;
  std::vector<ViewPoint> open;
  for (const ViewPoint& view :
       frontierPlaces(place_, parameters_.smallest_frontier, parameters_.smallest_gain)) {
    if (openOnes()(view)) open.push_back(view);
  }
  std::stable_sort(open.begin(), open.end(), [this](const ViewPoint& a, const ViewPoint& b) {
    return scoreOf(parameters_.strategy, a) > scoreOf(parameters_.strategy, b);
  });
  if (open.empty()) return false;
  const ViewPoint best = open.front();
  driveTo(best, robot_map, promiseOf(best) + ", at a frontier");
  open.resize(std::min(open.size(), kMostExplained), best);
  explain(robot_map, {best, "", DecisionRule::kFrontier, std::move(open), {}});
  return true;
}

void GlobalPlanner::explain(const Eigen::Vector2d& robot_map, const Choice& choice) const {
  if (!observer_) return;
  ExplainedDecision decision{robot_map, choice.rule, {}, {}, plan_.reason};
  for (std::size_t k = 0; k < choice.weighed.size(); ++k) {
    const ViewPoint& view = choice.weighed[k];
    if (!decision.chosen && view.cell == choice.view.cell) decision.chosen = k;
    decision.candidates.push_back(
        {grid().centreOf(view.cell), grid().centreOf(view.target), view.expected, view.distance,
         choice.costs.empty() ? scoreOf(parameters_.strategy, view) : choice.costs[k]});
  }
  observer_(decision);
}

/// For people. Its place is that in the map frame.
std::string GlobalPlanner::promiseOf(const ViewPoint& view) const {
  const Eigen::Vector2d p_map = grid().centreOf(view.target);
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(2);
  text << view.expected << " m^2";
  text.precision(1);
  text << " behind (" << p_map.x() << ", " << p_map.y() << "), " << view.distance << " m away";
  return text.str();
}

// Where no place promises much, all that is left is seen in a tour.
GlobalPlanner::Choice GlobalPlanner::nextStop(const ViewPoint& best) {
  const std::size_t shown = observer_ ? kMostExplained - 1 : 1;
  auto weighed = view_search_.nextBest(place_, parameters_.strategy, openOnes(), {best}, shown);
  const std::string next =
      weighed.empty() ? "nothing else is worth its way" : "next best " + promiseOf(weighed.front());
  weighed.insert(weighed.begin(), best);
  Choice by_score{best, next, DecisionRule::kScore, std::move(weighed), {}};
  if (parameters_.strategy != Strategy::kViewTour) return by_score;
  if (scoreOf(parameters_.strategy, best) >= kPromising) {
    const auto passed = view_search_.inPassing(place_, openOnes(), best);
    if (!passed) return by_score;
    by_score.weighed.insert(by_score.weighed.begin(), *passed);
    by_score.weighed.resize(std::min(by_score.weighed.size(), kMostExplained), best);
    return {*passed,
            "in passing, on the way to " + promiseOf(best),
            DecisionRule::kInPassing,
            std::move(by_score.weighed),
            {}};
  }
  const auto present = isGoalUnseen() ? std::optional<Cell>(goal_->target) : std::nullopt;
  auto stops = view_search_.stops(place_, openOnes());
  auto start = firstOfTour(place_, stops, present);
  if (!start) return by_score;
  const ViewPoint first = stops[start->first];
  const std::string found = "first of a tour of " + std::to_string(stops.size()) + " stops";
  return {first, found, DecisionRule::kTour, std::move(stops), std::move(start->costs)};
}

// The best of all places.
bool GlobalPlanner::search(const Eigen::Vector2d& robot_map) {
  if (place_.isHeld()) return false;
  const auto chosen = view_search_.next(place_, parameters_.strategy, openOnes());
  if (chosen) {
    const Choice choice = nextStop(*chosen);
    driveTo(choice.view, robot_map, promiseOf(choice.view) + "; " + choice.found);
    explain(robot_map, choice);
  } else if (!view_search_.isUnderWay()) {
    return false;
  } else if (isGoalUnseen() && place_.ways().isReached(goal_->cell)) {
    ViewPoint same = *goal_;
    same.distance = place_.ways().distanceTo(same.cell);
    driveTo(same, robot_map, promiseOf(same) + "; what else is left is being found out");
  } else {
    goal_.reset();
    plan_.reason = "to find out what is left to see";
  }
  return true;
}

void GlobalPlanner::lookAround() {
  plan_ = {};
  plan_.phase = PlanPhase::kLookingAround;
  plan_.reason = "to look around";
}

void GlobalPlanner::correct(const PastScans& past) {
  const CellMove moved = place_.correct(past);
  if (goal_) {
    goal_->cell = moved(goal_->cell);
    goal_->target = moved(goal_->target);
    plan_.look_at = grid().centreOf(goal_->target);
  }
  view_search_.forget();
  decided_at_ = past.correctionAt(decided_at_) * decided_at_;
  revealed_then_ = grid().revealed();
  is_corrected_ = true;
}

void GlobalPlanner::setGoalAside() {
  if (place_.lastPlace()) dropGoal(Failure::kNotReached, grid().cellOf(*place_.lastPlace()));
}

void GlobalPlanner::dropGoal(Failure failure, std::optional<Cell> held_at) {
  if (goal_) place_.noteFailure(goal_->target, failure, held_at);
  goal_.reset();
}

// Who stands in the only way for a moment may leave: it is tried again at once, but only once.
void GlobalPlanner::leaveWay(const std::vector<Eigen::Vector2d>& way, bool had_its_time) {
  if (!goal_ || !place_.lastPlace()) return;
  place_.bar(way);
  place_.findWays(*place_.lastPlace());
  const bool is_in_reach =
      place_.ways().isReached(goal_->cell) || view_search_.canBeSeen(place_, goal_->target);
  const Failure failure = had_its_time && !is_in_reach ? Failure::kNotReached : Failure::kWayLost;
  const bool is_aside =
      place_.noteFailure(goal_->target, failure, grid().cellOf(*place_.lastPlace()));
  if (is_aside || is_in_reach || !place_.open()) goal_.reset();
}

void GlobalPlanner::noteArrival() {
  if (goal_) place_.noteScanned(goal_->cell);
}

void GlobalPlanner::noteLookAround(const Eigen::Vector2d& robot_map) {
  if (grid().covers(robot_map)) place_.noteScanned(grid().cellOf(robot_map));
}

std::vector<Eigen::Vector2d> GlobalPlanner::pathTo(const Eigen::Vector2d& robot_map,
                                                   const Eigen::Vector2d& goal_map) {
  if (!grid().covers(robot_map) || !grid().covers(goal_map)) return {};
  constexpr int kNearEnough = 10;  // cells
  std::vector<Eigen::Vector2d> path;
  do {
    Cell goal;
    if (!nearestTraversable(space(), grid().cellOf(goal_map), kNearEnough, goal)) continue;
    place_.findWays(robot_map, goal);
    path = place_.wayTo(goal);
  } while (path.empty() && place_.open());
  return path;
}

}  // namespace cca
