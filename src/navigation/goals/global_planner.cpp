// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/global_planner.hpp"

#include <algorithm>
#include <utility>

#include "cca_mrpt/navigation/place/grid_paths.hpp"

namespace cca {
namespace {

// m^2, of gain exp(-0.2 way): a frontier that promises this is driven into. With less there is less
// way to 90 % coverage, with 1.5 a tenth more to 99 %; with 8 the reverse.
constexpr double kWorthEntering = 5.0;
constexpr double kReconsiderAfter = 0.3;         // m driven
constexpr std::size_t kWorthReconsidering = 20;  // cells newly seen
constexpr double kPassed = 0.1;                  // m, of a corner
constexpr int kMostTimesHeld = 3;                // at one place, in the last look
constexpr std::size_t kWorthAnotherLook = 200;   // cells newly seen: half a square metre
constexpr double kLongestInVain = 100.0;         // m, and once around what is known

}  // namespace

GlobalPlanner::GlobalPlanner(const GlobalPlannerParameters& parameters)
    : parameters_(parameters),
      place_(parameters.clearance),
      views_(parameters.smallest_gain, parameters.smallest_frontier),
      view_tour_(parameters.tour),
      last_look_(parameters.smallest_gain, parameters.smallest_frontier, parameters.worth),
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
    if (pathStands()) {
      view_tour_.prepare(grid(), space());
    } else {
      replan(robot_map);
    }
  }
  return plan_;
}

bool GlobalPlanner::isScanned(const Eigen::Vector2d& p_map) const {
  return place_.scanned().contains(grid().cellOf(p_map));
}

bool GlobalPlanner::isGoalUnseen() const {
  return goal_ && grid().at(goal_->target) == CellState::kUnknown;
}

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
      if (const auto chosen = choose()) {
        is_last_look_ = false;
        return driveTo(*chosen, robot_map, "to see what is behind a frontier");
      }
      if (lookLast(robot_map)) return;
    } while (opensMore());
  }
  goal_.reset();
  if (!isScanned(robot_map)) {
    lookAround();
    return;
  }
  plan_.phase = PlanPhase::kFinished;
  place_.findWays(robot_map);
  plan_.unreached = place_.unreached();
  const auto given_up = whyGivenUp();
  plan_.gave_up = given_up.has_value();
  plan_.reason = given_up.value_or(last_look_.whatIsLeft());
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
  if (place_.timesHeld() >= kMostTimesHeld)
    return "the robot does not get to what is left from where it stands";
  if (!place_.ways().isStarted())
    return "the robot stands where nothing around it is known to be free";
  return {};
}

/// A goal that there is no way to is set aside; the next step decides anew.
void GlobalPlanner::driveTo(const ViewPoint& chosen, const Eigen::Vector2d& robot_map,
                            const char* reason) {
  if (!goal_ || goal_->target != chosen.target) ++goals_;
  goal_ = chosen;
  plan_.look_at = grid().centreOf(chosen.target);
  plan_.reason = reason;
  if (!takeWayTo(chosen.cell, robot_map)) dropGoal(Failure::kNotReached);
}

void GlobalPlanner::findViews() {
  place_.findWays(decided_at_);
  views_.find(place_, grid().cellOf(decided_at_));
  if (is_last_look_ || !isGoalUnseen() || !views_.keep(place_, *goal_)) goal_.reset();
}

// Where nothing else is left, ways that were barred are open again.
bool GlobalPlanner::opensMore() {
  if (place_.timesHeld() >= kMostTimesHeld) return false;  // it gets nowhere from here
  if (!place_.open()) return false;
  revealed_at_last_look_.reset();
  return true;
}

// From all places, and again where much was seen since.
bool GlobalPlanner::lookLast(const Eigen::Vector2d& robot_map) {
  const auto is_open = [&](const ViewPoint& view) {
    return !place_.isAside(view.target) && views_.isWithinLimits(place_, view.cell) &&
           views_.isWithinLimits(place_, view.target);
  };
  const Strategy strategy =
      parameters_.strategy == Strategy::kViewTour ? Strategy::kGainDistance : parameters_.strategy;
  while (place_.timesHeld() < kMostTimesHeld) {
    if (const auto chosen = last_look_.next(place_, strategy, is_open)) {
      is_last_look_ = true;
      driveTo(*chosen, robot_map, "to see what is left");
      return true;
    }
    goal_.reset();
    if (last_look_.isUnderWay()) {
      plan_.reason = "to find out what is left to see";
      return true;
    }
    if (revealed_at_last_look_ && grid().revealed() < *revealed_at_last_look_ + kWorthAnotherLook)
      break;
    revealed_at_last_look_ = grid().revealed();
    last_look_.begin(place_);
  }
  return false;
}

void GlobalPlanner::lookAround() {
  plan_ = {};
  plan_.phase = PlanPhase::kLookingAround;
  plan_.reason = "to look around";
}

// While the last look is under way the views of before it would be out of date.
std::optional<ViewPoint> GlobalPlanner::choose() {
  if (last_look_.isUnderWay()) return {};
  findViews();
  const std::vector<ViewPoint>&views = views_.viewPoints(), &entries = views_.entries();
  if (parameters_.strategy != Strategy::kViewTour) {
    const auto best = selectGoal(parameters_.strategy, views);
    return best ? std::optional<ViewPoint>(views[*best]) : std::nullopt;
  }
  const auto entry = selectGoal(Strategy::kGainDistance, entries);
  if (entry && discountedGain(entries[*entry]) >= kWorthEntering) return entries[*entry];
  const auto present = goal_ ? std::optional<Cell>(goal_->target) : std::nullopt;
  const auto stop = view_tour_.choose(grid(), space(), views, views_.reach(place_), present);
  return stop ? std::optional<ViewPoint>(views[*stop]) : std::nullopt;
}

void GlobalPlanner::correct(const PastScans& past) {
  const CellMove moved = place_.correct(past);
  if (goal_) {
    goal_->cell = moved(goal_->cell);
    goal_->target = moved(goal_->target);
    plan_.look_at = grid().centreOf(goal_->target);
  }
  view_tour_ = ViewTour(parameters_.tour);
  last_look_ =
      LastLook(parameters_.smallest_gain, parameters_.smallest_frontier, parameters_.worth);
  revealed_at_last_look_.reset();
  is_corrected_ = true;
}

void GlobalPlanner::setGoalAside() { dropGoal(Failure::kNotReached, heldAt()); }

void GlobalPlanner::dropGoal(Failure failure, std::optional<Cell> held_at) {
  if (goal_) place_.noteFailure(goal_->target, failure, held_at);
  goal_.reset();
}

// Of the last look only: before it, each goal is tried from wherever the robot is.
std::optional<Cell> GlobalPlanner::heldAt() const {
  if (!is_last_look_ || !place_.lastPlace()) return {};
  return grid().cellOf(*place_.lastPlace());
}

// Where there is no other way, the place stays open for some more tries.
bool GlobalPlanner::goAround(const std::vector<Eigen::Vector2d>& way) {
  if (!goal_ || !place_.lastPlace()) return false;
  place_.bar(way);
  place_.findWays(*place_.lastPlace());
  const bool is_in_reach = is_last_look_ ? place_.ways().isReached(goal_->cell)
                                         : views_.viewOf(place_, goal_->target).has_value();
  if (!is_in_reach && place_.open()) return false;
  dropGoal(Failure::kWayLost, heldAt());
  return true;
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
