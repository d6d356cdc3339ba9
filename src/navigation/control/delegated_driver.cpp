// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/delegated_driver.hpp"

#include <cmath>
#include <utility>

namespace cca {
namespace {

constexpr double kTurn = 2.0 / 3.0 * M_PI;  // rad: three make one round, and none is ambiguous

}  // namespace

void DelegatedDriver::noteOutcome(DriveOutcome outcome) {
  const bool has_failed = outcome == DriveOutcome::kFailed;
  if (T_map_turned_) {
    T_map_turned_->theta = wrapAngle(T_map_turned_->theta + kTurn);
    if (!has_failed) return;
  }
  outcome_.status = has_failed ? GoalStatus::kGivenUp : GoalStatus::kReached;
}

Driver::Command DelegatedDriver::drive(const DriveTask& task, const Observation& seen,
                                       const WorldModel& /*world*/) {
  outcome_ = {task.goal};
  progress_.note(task.goal, task.path, seen.time, actuation_.robot(), task.looks_around);
  if (progress_.isOverdue(seen.time)) outcome_.status = GoalStatus::kGivenUp;
  if (task.looks_around) {
    if (!T_map_turned_) {
      T_map_turned_ = seen.T_map_robot;
      T_map_turned_->theta = wrapAngle(T_map_turned_->theta + kTurn);
    }
    return {{}, T_map_turned_};
  }
  T_map_turned_.reset();
  Pose2 T_map_goal{task.p_map.x(), task.p_map.y(), task.heading.value_or(0.0)};
  if (task.look_at_map) {
    const Eigen::Vector2d ahead = *task.look_at_map - task.p_map;
    T_map_goal.theta = std::atan2(ahead.y(), ahead.x());
  }
  return {{}, T_map_goal};
}

GoalOutcome DelegatedDriver::takeOutcome() {
  return std::exchange(outcome_, {outcome_.goal, GoalStatus::kUnderWay, {}});
}

// What others tell of a robot that stands by order is no failure.
void DelegatedDriver::pauseTimers(double time) {
  progress_.pauseTimers(time);
  takeOutcome();
}

void DelegatedDriver::correct(const PastScans& /*past*/) {
  T_map_turned_.reset();
  progress_.correctPath();
}

}  // namespace cca
