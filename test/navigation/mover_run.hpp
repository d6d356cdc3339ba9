// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "random_worlds.hpp"
#include "tangent_run.hpp"

namespace cca::testing {

/// Somebody who walks straight on, turns where a wall comes, and sees no robot.
struct Walker {
  Disc disc;
  Eigen::Vector2d velocity;
};

struct MoverRun {
  TangentBugState state = TangentBugState::kMotionToGoal;
  int contacts_while_moving = 0;    ///< the robot's fault
  int contacts_while_standing = 0;  ///< walked into
  double clearance = INFINITY;      ///< m, to walls
  double duration = 0.0, distance = 0.0;
};

/// A query with walkers in its world; ends with Tangent Bug or after `longest` seconds.
inline MoverRun runAmongMovers(Query query, int walkers, double speed, const RunOptions& options,
                               unsigned seed) {
  constexpr double kPeriod = 0.1, kWalk = 0.02;
  std::mt19937 generator(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(generator()) / 4294967296.0);
  };
  std::vector<Walker> crowd;
  for (int tries = 0; static_cast<int>(crowd.size()) < walkers && tries < 1000; ++tries) {
    const Disc disc{{uniform(0, query.width), uniform(0, query.height)}, 0.25};
    if (query.world.clearance(disc.center) < 0.3) continue;
    if ((disc.center - query.start.position()).norm() < 1.5) continue;
    const double heading = uniform(-M_PI, M_PI), v = uniform(0.3 * speed, speed);
    crowd.push_back({disc, {v * std::cos(heading), v * std::sin(heading)}});
  }
  TangentBug bug(options.robot);
  bug.setGoal(query.goal);
  MoverRun run;
  Pose2 pose = query.start;
  Velocity velocity;
  std::vector<bool> touching(crowd.size(), false);
  std::normal_distribution<double> noise(0.0, options.noise > 0.0 ? options.noise : 1.0);
  for (; run.duration < options.longest; run.duration += kPeriod) {
    query.world.discs.clear();
    for (const Walker& walker : crowd) query.world.discs.push_back(walker.disc);
    Scan scan = query.world.scan(pose, options.range, options.beams, options.field_of_view);
    for (double& r : scan.ranges) {
      if (options.noise > 0.0 && isReturn(r)) r = std::max(0.01, r + noise(generator));
    }
    const Velocity command = bug.step(scan, pose, velocity, run.duration);
    for (double t = 0.0; t < kPeriod - 1e-9; t += kWalk) {
      const Eigen::Vector2d before = pose.position();
      drive(command, options.robot, kWalk, pose, velocity);
      run.distance += (pose.position() - before).norm();
      for (std::size_t i = 0; i < crowd.size(); ++i) {
        Walker& walker = crowd[i];
        const Eigen::Vector2d next = walker.disc.center + walker.velocity * kWalk;
        if (query.world.clearance(next) < 0.27) {
          const double heading = uniform(-M_PI, M_PI), v = walker.velocity.norm();
          walker.velocity = {v * std::cos(heading), v * std::sin(heading)};
        } else {
          walker.disc.center = next;
        }
        const bool touches = walker.disc.distance(pose.position()) < options.robot.radius;
        const bool moves = std::abs(velocity.linear) > 0.01;
        if (touches && !touching[i])
          ++(moves ? run.contacts_while_moving : run.contacts_while_standing);
        touching[i] = touches;
      }
    }
    run.clearance = std::min(run.clearance, query.world.clearance(pose.position()));
    run.state = bug.state();
    if (run.state == TangentBugState::kReached || run.state == TangentBugState::kUnreachable) break;
  }
  return run;
}

}  // namespace cca::testing
