// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "navigation/control/delegated_driver.hpp"
#include "navigation/control/progress.hpp"
#include "navigation/control/tangent_bug_driver.hpp"
#include "navigation/planning/global_planner.hpp"
#include "navigation/world/world_model.hpp"

namespace cca {
namespace {

constexpr int kMostHeld = 2;  // times on one errand: the first may have been somebody who passed
// Number of the goal, see Plan::goal; those of errands lie below.
constexpr int kHomeGoal = Plan::kLookAround - 1;

// m^2, as small as the floor plan's smallest room; of a large place less than a twentieth is no
// more than a corner.
constexpr double kMuchUnreached = 1.0, kMuchOfAll = 0.05;

using Path = std::vector<Eigen::Vector2d>;

}  // namespace

const char* nameOf(ExplorationStatus status) {
  constexpr const char* kNames[] = {"exploring", "returning", "paused",     "finished",
                                    "driving",   "arrived",   "unreachable"};
  return kNames[static_cast<int>(status)];
}

/// A place that it was sent to.
struct Explorer::Errand {
  Pose2 T_map_goal;
  ProgressClock without_path;
  int held = 0;  ///< how often it got no farther
};

/// What to do in this step, and why.
struct Explorer::Intent {
  ExplorationStatus status;
  std::string reason;
  std::optional<Pose2> T_map_goal{};  ///< to be shown
  std::optional<DriveTask> task{};    ///< empty: to stand
};

Explorer::Explorer(const RobotParameters& robot, const ExplorerParameters& parameters)
    : parameters_(parameters),
      world_(std::make_unique<WorldModel>(robot.leastClearance())),
      planner_(std::make_unique<GlobalPlanner>(parameters, robot.radius)),
      driver_(std::make_unique<TangentBugDriver>(robot)),
      shut_in_(std::make_unique<ProgressClock>()) {}

Explorer::~Explorer() = default;
Explorer::Explorer(Explorer&&) noexcept = default;
Explorer& Explorer::operator=(Explorer&&) noexcept = default;

void Explorer::delegateDriving() {
  driver_ = std::make_unique<DelegatedDriver>(actuation().robot());
}

void Explorer::noteOutcome(DriveOutcome outcome) {
  if (auto* const delegated = dynamic_cast<DelegatedDriver*>(driver_.get())) {
    delegated->noteOutcome(outcome);
  }
}

void Explorer::changeMotion(const RobotParameters& robot) {
  driver_->changeMotion(actuation().robot().movingAs(robot));
}

void Explorer::observe(const Scan& scan, const Pose2& T_map_robot, double range_sigma) {
  world_->observe(scan, T_map_robot.position(), range_sigma);
}

void Explorer::correct(const PastScans& past) {
  planner_->correct(*world_, past, world_->correct(past));
  driver_->correct(past);
  if (T_map_start_) T_map_start_ = past.correctionAt(T_map_start_->position()) * *T_map_start_;
  if (errand_) {
    errand_->T_map_goal = past.correctionAt(errand_->T_map_goal.position()) * errand_->T_map_goal;
  }
}

Action Explorer::step(const Observation& observation) {
  Action action;
  if (isFinite(observation.T_map_robot) && isFinite(observation.scan.T_map_sensor)) {
    sense(observation);
    action = act(plan(observation), observation);
  } else {
    action.reason = "waiting for a pose that is a number";
    driver_->pauseTimers(observation.time);
  }
  driver_->noteSent(action.velocity, observation.velocity, observation.time);
  return action;
}

void Explorer::sense(const Observation& seen) {
  if (!T_map_start_) T_map_start_ = seen.T_map_robot;
  if (!seen.is_localised) return;
  world_->markHazards(seen.hazards);
  world_->observe(driver_->withoutMovers(seen.scan), seen.T_map_robot.position(),
                  seen.rangeSigma());
}

Explorer::Intent Explorer::plan(const Observation& seen) {
  if (errand_) return runErrand(seen);
  if (is_paused_) return stand(ExplorationStatus::kPaused, "paused", seen.time);
  if (driver_->needsPose() && !seen.is_localised) {
    return stand(ExplorationStatus::kExploring, "waiting until the pose is known again", seen.time);
  }
  return is_returning_ ? goHome(seen) : explore(seen);
}

Action Explorer::act(const Intent& intent, const Observation& seen) {
  Action action;
  action.status = intent.status;
  action.reason = intent.reason;
  std::optional<Pose2> T_map_goal = intent.T_map_goal;
  if (intent.task) {
    const Driver::Command command = driver_->drive(*intent.task, seen, *world_);
    action.velocity = command.velocity;
    if (command.T_map_goal) T_map_goal = command.T_map_goal;
  }
  if (T_map_goal) {
    action.goal = T_map_goal->position();
    action.goal_heading = T_map_goal->theta;
  }
  return action;
}

Explorer::Intent Explorer::stand(ExplorationStatus status, const std::string& reason, double time) {
  driver_->pauseTimers(time);
  return {status, reason};
}

/// @param path  where it is empty the robot waits for one.
DriveTask Explorer::taskTo(int goal, const Pose2& T_map_goal, Path path,
                           const Observation& seen) const {
  DriveTask task;
  task.goal = goal;
  task.p_map = T_map_goal.position();
  task.has_path = !path.empty();
  task.path = task.has_path ? std::move(path) : Path{seen.T_map_robot.position(), task.p_map};
  task.start_map = T_map_start_->position();
  return task;
}

Explorer::Intent Explorer::explore(const Observation& seen) {
  const Plan& plan = planner_->update(*world_, seen.T_map_robot.position(), driver_->takeOutcome());
  if (waitsForWay(plan, seen.time)) {
    DriveTask task =
        taskTo(Plan::kLookAround, seen.T_map_robot, {seen.T_map_robot.position()}, seen);
    task.looks_around = true;
    return {ExplorationStatus::kExploring, "waiting for a way to what is left", {}, task};
  }
  if (plan.isFinished()) {
    why_finished_ = plan.reason;
    is_returning_ = parameters_.return_to_start;
    return is_returning_ ? goHome(seen) : Intent{ExplorationStatus::kFinished, plan.reason};
  }
  Intent intent{ExplorationStatus::kExploring, plan.reason};
  if (plan.phase == PlanPhase::kUndecided) {
    if (plan.reason.empty()) intent.reason = "waiting for a scan";
    return intent;
  }
  const bool looks_around = plan.phase == PlanPhase::kLookingAround;
  const Eigen::Vector2d goal = looks_around ? seen.T_map_robot.position() : plan.path.back();
  intent.T_map_goal = Pose2{goal.x(), goal.y(), 0.0};
  intent.task = taskTo(plan.goal, *intent.T_map_goal, looks_around ? Path{goal} : plan.path, seen);
  intent.task->looks_around = looks_around;
  intent.task->goes_straight = parameters_.path == PathKind::kPaper;
  if (!looks_around) intent.task->look_at_map = plan.look_at;
  return intent;
}

/// Whether to wait: it may be that somebody stands in the way to what is left, or did a moment ago.
/// A wait is over for good where it was in vain, but for a goal that is found after all.
bool Explorer::waitsForWay(const Plan& plan, double time) {
  if (plan.phase == PlanPhase::kDriving) shut_in_->stop();
  if (!plan.isFinished() || plan.unreachedArea() < kMuchUnreached) return false;
  shut_in_->run(time);
  return !shut_in_->isOver(PathProgress::kPatience, time);
}

Explorer::Intent Explorer::goHome(const Observation& seen) {
  const Eigen::Vector2d robot = seen.T_map_robot.position();
  const std::string why = why_finished_.empty() ? "called back" : why_finished_;
  GoalOutcome outcome = driver_->takeOutcome();
  const bool is_of_home = outcome.goal == kHomeGoal;
  const bool is_back = is_of_home && outcome.status == GoalStatus::kReached;
  if (is_back || (robot - T_map_start_->position()).norm() < kBesideGoal)
    return {ExplorationStatus::kFinished, why + "; back at the start"};
  if (is_of_home && outcome.status == GoalStatus::kGivenUp)
    return {ExplorationStatus::kFinished, why + "; the way back to the start is blocked"};
  Path path = planner_->pathTo(*world_, robot, T_map_start_->position(), outcome.lost_path);
  Intent intent{ExplorationStatus::kReturning, "back to the start", T_map_start_};
  intent.task = taskTo(kHomeGoal, *T_map_start_, std::move(path), seen);
  intent.task->heading = T_map_start_->theta;
  return intent;
}

void Explorer::explainTo(DecisionObserver observer) { planner_->explainTo(std::move(observer)); }

void Explorer::limitTo(Path polygon) { planner_->limitTo(std::move(polygon)); }

const ActuationModel& Explorer::actuation() const { return driver_->actuation(); }

const ExplorationGrid& Explorer::grid() const { return world_->grid(); }

void Explorer::recall() { errand_.reset(); }

bool Explorer::isSent() const { return errand_ != nullptr; }

void Explorer::sendTo(const Pose2& T_map_goal) {
  errand_ = std::make_unique<Errand>(Errand{T_map_goal, {}});
  ++errands_;
}

Explorer::Intent Explorer::runErrand(const Observation& seen) {
  Intent intent{ExplorationStatus::kSent, "to where it was sent", errand_->T_map_goal};
  if (!seen.is_localised) {
    driver_->pauseTimers(seen.time);
    intent.reason = "waiting until the pose is known again";
    return intent;
  }
  const int number = kHomeGoal - errands_;
  const GoalOutcome outcome = driver_->takeOutcome();
  const bool is_of_errand = outcome.goal == number;
  if (is_of_errand && outcome.status == GoalStatus::kReached)
    return endErrand(ExplorationStatus::kArrived, "there");
  if (is_of_errand && !outcome.lost_path.empty()) ++errand_->held;
  if (errand_->held >= kMostHeld || (is_of_errand && outcome.status == GoalStatus::kGivenUp))
    return endErrand(ExplorationStatus::kUnreachable, "the robot does not get there");
  const Eigen::Vector2d goal = errand_->T_map_goal.position();
  Path path = planner_->pathTo(*world_, seen.T_map_robot.position(), goal, outcome.lost_path);
  if (!path.empty() && (path.back() - goal).norm() >= kBesideGoal) path.clear();
  if (path.empty()) {
    errand_->without_path.run(seen.time);
    if (errand_->without_path.isOver(PathProgress::kPatience, seen.time))
      return endErrand(ExplorationStatus::kUnreachable, "no known way leads there");
    intent.reason = "waiting for a way to where it was sent";
  } else {
    errand_->without_path.stop();
  }
  Pose2 T_map_end = errand_->T_map_goal;
  if (!path.empty()) T_map_end = {path.back().x(), path.back().y(), T_map_end.theta};
  intent.task = taskTo(number, T_map_end, std::move(path), seen);
  intent.task->heading = T_map_end.theta;
  return intent;
}

Explorer::Intent Explorer::endErrand(ExplorationStatus status, const std::string& reason) {
  errand_.reset();
  return {status, reason};
}

bool Explorer::isIncomplete() const {
  const double side = grid().resolution();
  const double seen = static_cast<double>(grid().revealed()) * side * side;
  return planner_->plan().isFinished() &&
         planner_->plan().passableArea() > std::max(kMuchUnreached, kMuchOfAll * seen);
}

}  // namespace cca
