// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "navigation/control/driver.hpp"
#include "navigation/control/progress.hpp"

namespace cca {

/// Somebody else drives to the goals, a navigation that knows of footprints that are no discs:
/// velocities are zero. A goal without an outcome has its time as any other; that its path does not
/// become shorter says nothing, for others have paths of their own.
class DelegatedDriver : public Driver {
 public:
  explicit DelegatedDriver(const RobotParameters& robot) : actuation_(robot) {}

  /// What has become of the goal of the last step.
  void noteOutcome(DriveOutcome outcome);

  /// Looking around is done in three turns of the goal's heading.
  Command drive(const DriveTask& task, const Observation& seen, const WorldModel& world) override;
  GoalOutcome takeOutcome() override;
  void pauseTimers(double time) override;
  void correct(const PastScans& past) override;
  /// What others command is not known, nor what it would show of the base.
  void noteSent(const Velocity& /*command*/, const Velocity& /*measured*/,
                double /*time*/) override {}
  void changeMotion(const RobotParameters& robot) override { actuation_.changeMotion(robot); }
  bool needsPose() const override { return true; }
  const ActuationModel& actuation() const override { return actuation_; }

 private:
  ActuationModel actuation_;  ///< as told
  PathProgress progress_;
  std::optional<Pose2> T_map_turned_;  ///< while looking around
  GoalOutcome outcome_;
};

}  // namespace cca
