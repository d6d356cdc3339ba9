// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "box_world.hpp"
#include "navigation/control/tangent_bug/tangent_bug.hpp"

namespace cca::testing {

/// How a drive ended.
struct TangentRun {
  TangentBugState state = TangentBugState::kMotionToGoal;
  Pose2 pose;
  double distance = 0.0;        ///< m
  double duration = 0.0;        ///< s
  double clearance = INFINITY;  ///< m, the least distance between the robot's centre and a wall
  std::vector<Eigen::Vector2d> path;
};

struct RunOptions {
  RobotParameters robot;
  double range = 8.0;
  double noise = 0.0;
  double field_of_view = 2.0 * M_PI;
  int beams = 361;
  double longest = 600.0;  ///< s, simulated
  unsigned seed = 1;
};

/// Drives from the start until Tangent Bug ends or the time is up.
inline TangentRun run(const BoxWorld& world, const Pose2& start, const Eigen::Vector2d& goal,
                      const RunOptions& options = {}) {
  constexpr double kPeriod = 0.1;
  TangentBug bug(options.robot);
  bug.setGoal(goal);
  TangentRun run;
  run.pose = start;
  Velocity velocity;
  std::mt19937 generator(options.seed);
  std::normal_distribution<double> noise(0.0, options.noise > 0.0 ? options.noise : 1.0);
  for (; run.duration < options.longest; run.duration += kPeriod) {
    Scan scan = world.scan(run.pose, options.range, options.beams, options.field_of_view);
    if (options.noise > 0.0) {
      for (double& r : scan.ranges) {
        if (isReturn(r)) r = std::max(0.01, r + noise(generator));
      }
    }
    const Velocity command = bug.step(scan, run.pose, velocity, run.duration);
    const Eigen::Vector2d before = run.pose.position();
    drive(command, options.robot, kPeriod, run.pose, velocity);
    run.distance += (run.pose.position() - before).norm();
    run.clearance = std::min(run.clearance, world.clearance(run.pose.position()));
    run.path.push_back(run.pose.position());
    run.state = bug.state();
    const bool ended =
        run.state == TangentBugState::kReached || run.state == TangentBugState::kUnreachable;
    if (ended && velocity.linear == 0.0 && velocity.angular == 0.0) break;
  }
  return run;
}

}  // namespace cca::testing
