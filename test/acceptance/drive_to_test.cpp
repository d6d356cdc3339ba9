// SPDX-License-Identifier: BSD-3-Clause
//
// Robots that are sent from place to place of a plan that they have not seen, among people who walk
// about. CCA_DRIVES sets how many places in each world; docs/log/localisation.md has the results.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"
#include "known_map/planned_sights.hpp"
#include "localised_drive.hpp"
#include "navigation/planning/global_planner.hpp"
#include "navigation/world/world_model.hpp"
#include "simulation/random.hpp"

namespace cca {
namespace {

constexpr double kLongest = 300.0;                 // s, of one drive
constexpr double kArrived = 0.99, kDetour = 1.15;  // what is asked for
constexpr double kAside = 0.25;                    // m, of a place that is no view point

int drives() {
  const char* text = std::getenv("CCA_DRIVES");
  return text ? std::atoi(text) : 5;
}

struct Tally {
  int sent = 0, arrived = 0, contacts = 0;
  double way = 0.0, shortest = 0.0;  ///< m, of those that arrived
};

double lengthOf(const std::vector<Eigen::Vector2d>& path) {
  double length = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
  return length;
}

/// @return  whether it has arrived.
bool driveTo(const Pose2& T_map_goal, Simulation& simulation, Explorer& explorer, double period) {
  explorer.sendTo(T_map_goal);
  for (const double end = simulation.time() + kLongest; simulation.time() < end;) {
    const Action action = explorer.step(simulation.observe());
    if (action.status == ExplorationStatus::kArrived) return true;
    if (action.status == ExplorationStatus::kUnreachable) return false;
    simulation.drive(action.velocity, period);
  }
  explorer.recall();
  return false;
}

Tally drivesIn(const std::string& name) {
  const std::string stem = std::string(CCA_MAPS_FOLDER) + "/" + name;
  const Parameters parameters;
  const World world = loadWorld(stem + ".yaml");
  const Pose2 start = defaultStart(world, parameters.robot.radius);
  const auto movers = std::filesystem::exists(stem + ".movers.yaml")
                          ? loadMovers(stem + ".movers.yaml", world)
                          : std::vector<Mover>();
  Simulation simulation(world, start, SimulationParameters(), movers);
  Explorer explorer(parameters.robot, parameters.exploration);
  WorldModel known(parameters.robot.leastClearance());
  GlobalPlanner planner(parameters.exploration, parameters.robot.radius);
  const std::vector<Scan> sights = plannedSights(PlanLines(test::trueLines(name)), start.position(),
                                                 parameters.robot.leastClearance());
  for (const Scan& sight : sights) {
    explorer.observe(sight, sight.T_map_sensor, rangeNoise(sight).range_sigma);
    known.observe(sight, sight.T_map_sensor.position());
  }
  Random random(7);
  Tally tally;
  while (tally.sent < drives()) {
    const Scan& sight =
        sights[static_cast<std::size_t>(random.integer(0, static_cast<int>(sights.size()) - 1))];
    const Pose2 goal{sight.T_map_sensor.x + random.uniform(-kAside, kAside),
                     sight.T_map_sensor.y + random.uniform(-kAside, kAside),
                     random.uniform(-M_PI, M_PI)};
    const auto way = planner.pathTo(known, simulation.T_map_robot().position(), goal.position());
    if (way.empty() || (way.back() - goal.position()).norm() > 0.05) continue;
    const double before = simulation.distance();
    ++tally.sent;
    const bool has_arrived = driveTo(goal, simulation, explorer, parameters.run.control_period);
    const double off = (simulation.T_map_robot().position() - goal.position()).norm();
    if (!has_arrived || off > 0.25) {
      std::printf("  %s: not at %.2f, %.2f but at %.2f, %.2f\n", name.c_str(), goal.x, goal.y,
                  simulation.T_map_robot().x, simulation.T_map_robot().y);
      continue;
    }
    ++tally.arrived;
    tally.way += simulation.distance() - before;
    tally.shortest += lengthOf(way);
  }
  tally.contacts = simulation.collisions();
  return tally;
}

TEST(DriveTo, RandomPlacesOfAPlanAreReachedWithoutAContact) {
  // In the office two walkers at the end of a corridor and the robot behind them would wait
  // for one another for ever.
  std::vector<std::string> worlds{"apartment", "office"};
  if (drives() >= 12) worlds = {"apartment", "office", "gallery", "random", "warehouse"};
  for (const std::string& name : worlds) {
    const Tally tally = drivesIn(name);
    std::printf("%-12s %d of %d arrived, %d contacts, way / shortest %.3f\n", name.c_str(),
                tally.arrived, tally.sent, tally.contacts, tally.way / tally.shortest);
    EXPECT_GE(tally.arrived, kArrived * tally.sent) << name;
    EXPECT_EQ(tally.contacts, 0) << name;
    EXPECT_LE(tally.way, kDetour * tally.shortest) << name;
  }
}

}  // namespace
}  // namespace cca
