// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/global_planner.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace cca {
namespace {

/// m driven: a place 0.4 m away is another one (the spacing of view points).
constexpr double kReconsiderAfter = 0.5;
constexpr std::size_t kWorthReconsidering = 20;  // cells newly seen: 5 dm^2
constexpr double kPassed = 0.1;                  // m, two cells: a corner is no truer than these
constexpr std::size_t kMostShown = 12;           // places of a decision, for people
constexpr double kLongestInVain = 100.0;         // m, and once around what is known

/// For people. Its place is that in the map frame.
std::string promiseOf(const ExplorationGrid& grid, const ViewPoint& view) {
  const Eigen::Vector2d p_map = grid.centreOf(view.target);
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(2);
  text << view.expected << " m^2";
  text.precision(1);
  text << " behind (" << p_map.x() << ", " << p_map.y() << "), " << view.distance << " m away";
  return text.str();
}

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

GlobalPlanner::GlobalPlanner(const GlobalPlannerParameters& parameters, double radius)
    : parameters_(parameters),
      radius_(radius),
      view_search_(parameters.smallest_gain, parameters.smallest_frontier, parameters.worth),
      budget_(parameters.worth) {}

const Plan& GlobalPlanner::update(const WorldModel& world, const Eigen::Vector2d& robot_map,
                                  const GoalOutcome& outcome) {
  const ExplorationGrid& grid = world.grid();
  if (!grid.covers(robot_map) || grid.revealed() == 0) return plan_;
  PlanningScene scene = sceneOf(world);
  applyOutcome(scene, robot_map, outcome);
  budget_.note(robot_map,
               static_cast<double>(grid.revealed()) * grid.resolution() * grid.resolution());
  // What stands beside a laser of less than 360 degrees is not known before it has turned once.
  if (!has_looked_around_) has_looked_around_ = scene.isExhausted(grid.cellOf(robot_map));
  if (!has_looked_around_) {
    lookAround();
    return plan_;
  }
  if (!goalStands(scene) || drivesInVain(grid) || isTimeToReconsider(grid, robot_map)) {
    decide(scene, robot_map);
  } else if (std::exchange(is_corrected_, false)) {
    replan(scene, robot_map);
  } else {
    advance(scene, robot_map);
    if (!pathStands(scene)) replan(scene, robot_map);
  }
  return plan_;
}

void GlobalPlanner::applyOutcome(PlanningScene& scene, const Eigen::Vector2d& robot_map,
                                 const GoalOutcome& outcome) {
  if (outcome.status == GoalStatus::kUnderWay || outcome.goal != plan_.goal) return;
  if (plan_.phase == PlanPhase::kLookingAround) {  // it sees no more from here
    scene.addExhausted(scene.grid().cellOf(robot_map));
  } else if (!goal_) {
    return;
  } else if (outcome.status == GoalStatus::kReached) {
    scene.addExhausted(goal_->cell);
  } else if (!outcome.lost_path.empty()) {
    abandonPath(scene, robot_map, outcome);
  } else {
    dropGoal(scene, Failure::kNotReached, scene.grid().cellOf(robot_map));
  }
}

// Who stands in the only path for a moment may leave: it is tried again at once, but only once.
void GlobalPlanner::abandonPath(PlanningScene& scene, const Eigen::Vector2d& robot_map,
                                const GoalOutcome& outcome) {
  scene.blockPath(outcome.lost_path);
  scene.findPaths(robot_map);
  const bool is_in_reach =
      scene.distances().isReached(goal_->cell) || view_search_.canBeSeen(scene, goal_->target);
  const bool is_final = outcome.status != GoalStatus::kStuck && !is_in_reach;
  const Failure failure = is_final ? Failure::kNotReached : Failure::kPathLost;
  const bool is_blacklisted =
      scene.addFailure(goal_->target, failure, scene.grid().cellOf(robot_map));
  if (is_blacklisted || is_in_reach || !scene.unblock()) goal_.reset();
}

bool GlobalPlanner::isGoalUnseen(const WorldModel& world) const {
  return goal_ && world.isUnseen(goal_->target);
}

bool GlobalPlanner::goalStands(const PlanningScene& scene) const {
  return isGoalUnseen(scene.world()) && !scene.isExhausted(goal_->cell);
}

bool GlobalPlanner::pathStands(const PlanningScene& scene) const {
  const double r = scene.grid().resolution();
  for (std::size_t i = 1; i < plan_.path.size(); ++i) {
    if (!isClearLine(scene.space(), plan_.path[i - 1] / r, plan_.path[i] / r)) return false;
  }
  return true;
}

// The path begins at the robot, and corners are left out as soon as the next one is in clear line.
void GlobalPlanner::advance(const PlanningScene& scene, const Eigen::Vector2d& robot_map) {
  std::vector<Eigen::Vector2d>& path = plan_.path;
  path.front() = robot_map;
  const double r = scene.grid().resolution();
  while (path.size() > 2 && ((path[1] - robot_map).norm() < kPassed ||
                             isClearLine(scene.space(), robot_map / r, path[2] / r))) {
    path.erase(path.begin() + 1);
  }
}

// Another path to the same goal; another goal only where there is no path left.
void GlobalPlanner::replan(PlanningScene& scene, const Eigen::Vector2d& robot_map) {
  scene.findPaths(robot_map, goal_->cell);
  if (takePathTo(scene, goal_->cell, robot_map)) return;
  if (scene.addFailure(goal_->target, Failure::kPathLost)) goal_.reset();
  decide(scene, robot_map);
}

bool GlobalPlanner::takePathTo(const PlanningScene& scene, Cell goal,
                               const Eigen::Vector2d& robot_map) {
  plan_.path = scene.pathTo(goal);
  if (plan_.path.size() == 1) plan_.path.insert(plan_.path.begin(), robot_map);
  plan_.phase = plan_.path.empty() ? PlanPhase::kUndecided : PlanPhase::kDriving;
  return plan_.phase == PlanPhase::kDriving;
}

// A decision is made again only after something new was seen: what was the best stays the best
// otherwise, and a finite place cannot be circled for ever.
bool GlobalPlanner::isTimeToReconsider(const ExplorationGrid& grid,
                                       const Eigen::Vector2d& robot_map) const {
  return parameters_.strategy == Strategy::kViewTour &&
         (robot_map - decided_.robot_map).norm() > kReconsiderAfter &&
         grid.revealed() > decided_.revealed + kWorthReconsidering;
}

void GlobalPlanner::decide(PlanningScene& scene, const Eigen::Vector2d& robot_map) {
  if (isGoalUnseen(scene.world()) && scene.isExhausted(goal_->cell)) {
    dropGoal(scene, Failure::kNothingSeen);
  }
  is_corrected_ = false;
  decided_ = {robot_map, scene.grid().revealed()};
  plan_ = {};
  if (!drivesInVain(scene.grid())) {
    do {
      scene.findPaths(robot_map);
      if (driveToFrontier(scene, robot_map) || search(scene, robot_map)) return;
    } while (!scene.isHeld() && scene.unblock());  // where it is held it gets nowhere from here
  }
  goal_.reset();
  if (scene.isExhausted(scene.grid().cellOf(robot_map))) return finish(scene, robot_map);
  lookAround();
}

// What was not reached is found out once for what was seen.
void GlobalPlanner::finish(PlanningScene& scene, const Eigen::Vector2d& robot_map) {
  const std::size_t revealed = scene.grid().revealed();
  plan_.phase = PlanPhase::kFinished;
  scene.findPaths(robot_map);
  if (unreached_.revealed != revealed) {
    unreached_ = {unreachedParts(scene, robot_map, radius_), revealed};
  }
  plan_.unreached = unreached_.parts;
  const auto given_up = whyGivenUp(scene);
  plan_.gave_up = given_up.has_value();
  plan_.reason = given_up.value_or(view_search_.whatIsLeft());
  explain(scene.grid(), robot_map, {{}, "", DecisionRule::kNone, {}});
}

// The way there and back between the farthest places of a building is not in vain yet.
bool GlobalPlanner::drivesInVain(const ExplorationGrid& grid) const {
  const Cell low = grid.lowest(), high = grid.highest();
  const double around = 2.0 * grid.resolution() * (high.x - low.x + high.y - low.y);
  return budget_.unpaid() > kLongestInVain + around;
}

std::optional<std::string> GlobalPlanner::whyGivenUp(const PlanningScene& scene) const {
  if (drivesInVain(scene.grid())) {
    const auto frontiers = scene.world().frontiers();
    const auto left = std::count_if(frontiers.begin(), frontiers.end(), [&](const Frontier& f) {
      return f.cells.size() >= parameters_.smallest_frontier;
    });
    return "driving shows hardly anything new any more; " + std::to_string(left) +
           " frontiers are left";
  }
  if (scene.isHeld()) return "the robot does not get to what is left from where it stands";
  if (!scene.distances().isStarted())
    return "the robot stands where nothing around it is known to be free";
  return {};
}

/// A goal that there is no path to is blacklisted; the next step decides anew.
void GlobalPlanner::driveTo(PlanningScene& scene, const ViewPoint& chosen,
                            const Eigen::Vector2d& robot_map, const std::string& reason) {
  if (!goal_ || goal_->target != chosen.target) ++goals_;
  goal_ = chosen;
  plan_.goal = goals_;
  plan_.look_at = scene.grid().centreOf(chosen.target);
  plan_.reason = reason;
  if (!takePathTo(scene, chosen.cell, robot_map)) dropGoal(scene, Failure::kNotReached);
}

bool GlobalPlanner::isWithinLimits(const Eigen::Vector2d& p_map) const {
  return limits_.size() < 3 || isInside(limits_, p_map);
}

ViewSearch::Filter GlobalPlanner::openOnes(const PlanningScene& scene) const {
  return [this, &scene](const ViewPoint& view) {
    return !scene.isBlacklisted(view.target) && isWithinLimits(scene.grid().centreOf(view.cell)) &&
           isWithinLimits(scene.grid().centreOf(view.target));
  };
}

// By the strategies of others, whose goals are frontiers.
bool GlobalPlanner::driveToFrontier(PlanningScene& scene, const Eigen::Vector2d& robot_map) {
  if (parameters_.strategy == Strategy::kViewTour) return false;
  std::vector<ViewPoint> open;
  for (const ViewPoint& view :
       frontierPlaces(scene, parameters_.smallest_frontier, parameters_.smallest_gain)) {
    if (openOnes(scene)(view)) open.push_back(view);
  }
  std::stable_sort(open.begin(), open.end(), [this](const ViewPoint& a, const ViewPoint& b) {
    return scoreOf(parameters_.strategy, a) > scoreOf(parameters_.strategy, b);
  });
  if (open.empty()) return false;
  const ViewPoint best = open.front();
  driveTo(scene, best, robot_map, promiseOf(scene.grid(), best) + ", at a frontier");
  open.resize(std::min(open.size(), kMostShown), best);
  explain(scene.grid(), robot_map, {best, "", DecisionRule::kFrontier, std::move(open)});
  return true;
}

void GlobalPlanner::explain(const ExplorationGrid& grid, const Eigen::Vector2d& robot_map,
                            const Choice& choice) const {
  if (!observer_) return;
  ExplainedDecision decision{robot_map, choice.rule, {}, {}, plan_.reason};
  for (std::size_t k = 0; k < choice.weighed.size(); ++k) {
    const ViewPoint& view = choice.weighed[k];
    if (!decision.chosen && view.cell == choice.view.cell) decision.chosen = k;
    decision.candidates.push_back({grid.centreOf(view.cell), grid.centreOf(view.target),
                                   view.expected, view.distance,
                                   scoreOf(parameters_.strategy, view)});
  }
  observer_(decision);
}

GlobalPlanner::Choice GlobalPlanner::nextStop(const PlanningScene& scene, const ViewPoint& best) {
  const ViewSearch::Filter open = openOnes(scene);
  const std::size_t shown = observer_ ? kMostShown - 1 : 1;
  auto weighed = view_search_.nextBest(parameters_.strategy, open, {best}, shown);
  const std::string next = weighed.empty()
                               ? "nothing else is worth its way"
                               : "next best " + promiseOf(scene.grid(), weighed.front());
  weighed.insert(weighed.begin(), best);
  const bool may_pass = parameters_.strategy == Strategy::kViewTour;
  const auto passed = may_pass ? view_search_.onTheWay(scene, open, best) : std::nullopt;
  if (!passed) return {best, next, DecisionRule::kScore, std::move(weighed)};
  weighed.insert(weighed.begin(), *passed);
  weighed.resize(std::min(weighed.size(), kMostShown), best);
  return {*passed, "in passing, on the way to " + promiseOf(scene.grid(), best),
          DecisionRule::kInPassing, std::move(weighed)};
}

// The best of all places.
bool GlobalPlanner::search(PlanningScene& scene, const Eigen::Vector2d& robot_map) {
  if (scene.isHeld()) return false;
  const auto chosen = view_search_.next(scene, parameters_.strategy, openOnes(scene));
  if (chosen) {
    const Choice choice = nextStop(scene, *chosen);
    driveTo(scene, choice.view, robot_map,
            promiseOf(scene.grid(), choice.view) + "; " + choice.found);
    explain(scene.grid(), robot_map, choice);
  } else if (!view_search_.isUnderWay()) {
    return false;
  } else if (isGoalUnseen(scene.world()) && scene.distances().isReached(goal_->cell)) {
    ViewPoint same = *goal_;
    same.distance = scene.distances().distanceTo(same.cell);
    driveTo(scene, same, robot_map,
            promiseOf(scene.grid(), same) + "; what else is left is being found out");
  } else {
    goal_.reset();
    plan_.reason = "to find out what is left to see";
  }
  return true;
}

void GlobalPlanner::lookAround() {
  plan_ = {};
  plan_.phase = PlanPhase::kLookingAround;
  plan_.goal = Plan::kLookAround;
  plan_.reason = "to look around";
}

void GlobalPlanner::correct(const WorldModel& world, const PastScans& past, const CellMove& moved) {
  blacklist_.reindex(moved, world.grid().revealed());
  if (goal_) {
    goal_->cell = moved(goal_->cell);
    goal_->target = moved(goal_->target);
    plan_.look_at = world.grid().centreOf(goal_->target);
  }
  view_search_.forget();
  decided_ = {past.correctionAt(decided_.robot_map) * decided_.robot_map, world.grid().revealed()};
  is_corrected_ = true;
}

void GlobalPlanner::dropGoal(PlanningScene& scene, Failure failure, std::optional<Cell> held_at) {
  if (goal_) scene.addFailure(goal_->target, failure, held_at);
  goal_.reset();
}

std::vector<Eigen::Vector2d> GlobalPlanner::pathTo(const WorldModel& world,
                                                   const Eigen::Vector2d& robot_map,
                                                   const Eigen::Vector2d& goal_map,
                                                   const std::vector<Eigen::Vector2d>& lost_path) {
  PlanningScene scene = sceneOf(world);
  scene.blockPath(lost_path);
  if (!scene.grid().covers(robot_map) || !scene.grid().covers(goal_map)) return {};
  std::vector<Eigen::Vector2d> path;
  do {
    Cell goal;
    if (!nearestTraversable(scene.space(), scene.grid().cellOf(goal_map), kBesideWalls, goal))
      continue;
    scene.findPaths(robot_map, goal);
    path = scene.pathTo(goal);
  } while (path.empty() && scene.unblock());
  return path;
}

}  // namespace cca
