// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "navigation/control/driver.hpp"
#include "navigation/control/progress.hpp"
#include "navigation/control/tangent_bug/tangent_bug.hpp"

namespace cca {

/// Drives by Tangent Bug, from corner to corner of the path.
class TangentBugDriver : public Driver {
 public:
  explicit TangentBugDriver(const RobotParameters& robot) : tangent_bug_(robot) {}

  /// The robot is stuck where what is left of the path does not become shorter; not where it goes
  /// straight: Tangent Bug may have to drive away from the goal for long. Where it fails, the lost
  /// path is told.
  Command drive(const DriveTask& task, const Observation& seen, const WorldModel& world) override;
  GoalOutcome takeOutcome() override;
  void pauseTimers(double time) override;
  void correct(const PastScans& past) override;
  void noteSent(const Velocity& command, const Velocity& measured, double time) override {
    tangent_bug_.controller().noteSent(command, measured, time);
  }
  void changeMotion(const RobotParameters& robot) override {
    tangent_bug_.controller().motion().changeMotion(robot);
  }
  Scan withoutMovers(Scan scan) const override;
  bool needsPose() const override { return false; }
  const ActuationModel& actuation() const override {
    return tangent_bug_.controller().motion().actuation();
  }

 private:
  const RobotParameters& robot() const { return tangent_bug_.robot(); }
  Velocity driveTo(const Eigen::Vector2d& way_point_map, const DriveTask& task,
                   const Observation& seen, const WorldModel& world);
  void turnOnTheSpot(double rate, Velocity& velocity) const;
  bool turnAsTold(const DriveTask& task, const Observation& seen, Velocity& velocity) const;
  GoalStatus statusOf(const DriveTask& task, const Observation& seen, bool is_last,
                      Velocity& velocity);

  /// The frame that Tangent Bug drives in: where the map is corrected, the robot goes on smoothly.
  Pose2 T_drive_map_;
  TangentBug tangent_bug_;  ///< in the drive frame
  PathProgress progress_;
  GoalOutcome outcome_;
};

}  // namespace cca
