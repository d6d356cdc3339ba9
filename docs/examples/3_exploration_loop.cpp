// SPDX-License-Identifier: BSD-3-Clause
// Example 3: an exploration in a loop of one's own. Here the robot is simulated; a real one gives
// its scan, pose and velocity in place of Simulation, and takes the velocity. Link cca_mrpt::io.
// Usage: 3_exploration_loop WORLD.yaml FOLDER
#include <cstdio>
#include <exception>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/session/exploration_session.hpp"
#include "cca_mrpt/simulation/simulation.hpp"

namespace {
constexpr double kControlPeriod = 0.1;  // s
constexpr double kLongestRun = 3600.0;  // s, simulated
}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 3_exploration_loop WORLD.yaml FOLDER\n");
    return 2;
  }
  cca::SimulationParameters parameters;
  cca::World world = cca::loadWorld(argv[1]);
  const cca::Pose2 start = cca::defaultStart(world, parameters.robot.radius);
  cca::Simulation robot(std::move(world), start, parameters);

  cca::ExplorationSession::Settings settings;
  settings.robot = parameters.robot;
  cca::ExplorationSession session(std::make_unique<cca::GivenPoses>(), settings);
  cca::Action action;
  while (action.status != cca::ExplorationStatus::kFinished && robot.time() < kLongestRun) {
    const cca::Observation seen = robot.observe();
    const auto measurement = cca::measurementOf(seen, robot.T_odom_robot());
    action = session.decide(session.sense(measurement, seen.velocity));
    robot.drive(action.velocity, kControlPeriod);
  }

  cca::MapProducts products = cca::mapProducts(argv[1], session.mapping());
  products.summary["reason"] = action.reason;
  cca::writeMapFolder(argv[2], products);
  std::printf("%s; %.0f m in %.0f s, %zu lines\n", action.reason.c_str(), robot.distance(),
              robot.time(), products.lines.size());
  return action.status == cca::ExplorationStatus::kFinished ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
