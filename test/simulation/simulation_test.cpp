// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/simulation.hpp"
#include "simulation/laser.hpp"
#include "simulation/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cca::simulation_test {
namespace {

/// A room of 6 x 4 m with a wall one cell thick in its middle, open at one end.
World room() {
  const int width = 120, height = 80;
  std::vector<unsigned char> cells(width * height, 0);
  for (int iy = 0; iy < 60; ++iy) cells[iy * width + 60] = 1;
  return World("room", width, height, cells, 0.05, {0.0, 0.0});
}

TEST(Simulation, StopsAtAWallAndCountsOneCollision) {
  Simulation simulation(room(), {1.0, 1.0, 0.0}, {});
  simulation.drive({0.5, 0.0}, 20.0);
  EXPECT_EQ(simulation.collisions(), 1);
  EXPECT_LE(simulation.T_map_robot().x, 3.0 - 0.25 + 1e-6);
  EXPECT_GT(simulation.T_map_robot().x, 3.0 - 0.25 - 0.02);
  simulation.drive({-0.3, 0.0}, 2.0);
  simulation.drive({0.5, 0.0}, 5.0);
  EXPECT_EQ(simulation.collisions(), 2);
}

TEST(Simulation, AScanOfASweepingLaserIsOfTheTimeBefore) {
  SimulationParameters parameters;
  parameters.laser.range_noise = 0.0;
  parameters.laser.sweep = 0.2;
  Simulation simulation(room(), {1.0, 2.0, 0.0}, parameters);
  simulation.drive({0.0, 1.0}, 2.0);
  const Scan scan = simulation.observe().scan;
  EXPECT_NEAR(simulation.scanned().time, 1.9, 1e-9);
  const double rate = simulation.velocity().angular;
  EXPECT_NEAR(scan.T_map_sensor.theta, simulation.T_map_robot().theta - 0.1 * rate, 1e-6);
  for (const std::size_t beam : {0u, 100u, 360u}) {
    const double time = 0.2 * (static_cast<double>(beam) / 360.0 - 1.0);
    const double bearing = simulation.T_map_robot().theta + time * rate + scan.bearing(beam);
    EXPECT_NEAR(scan.ranges[beam],
                castBeam(simulation.world(), scan.T_map_sensor.position(), bearing, 8.0), 1e-6);
  }
}

TEST(Simulation, NeverStandsInAWallHoweverItIsDriven) {
  SimulationParameters parameters;
  parameters.robot.max_linear_velocity = 5.0;
  parameters.robot.max_linear_acceleration = 50.0;
  Simulation simulation(room(), {1.0, 1.0, 0.0}, parameters);
  Random random(11);
  for (int i = 0; i < 400; ++i) {
    simulation.drive({random.uniform(-1.0, 5.0), random.uniform(-2.0, 2.0)}, 0.3);
  }
  EXPECT_GT(simulation.collisions(), 5);
  double nearest = 1.0;
  for (const auto& [time, T] : simulation.trajectory()) {
    nearest = std::min(nearest, simulation.world().clearance(T.position(), 1.0));
  }
  EXPECT_GE(nearest, 0.25 - 1e-6);
}

TEST(Simulation, KeepsWithinVelocityAndAccelerationLimits) {
  Simulation simulation(room(), {1.0, 1.0, 1.57}, {});
  const RobotParameters& limits = simulation.parameters().robot;
  Velocity before = simulation.velocity();
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    simulation.drive({random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)}, 0.05);
    const Velocity now = simulation.velocity();
    EXPECT_LE(std::abs(now.linear), limits.max_linear_velocity + 1e-12);
    EXPECT_LE(std::abs(now.angular), limits.max_angular_velocity + 1e-12);
    EXPECT_LE(std::abs(now.angular - before.angular),
              limits.max_angular_acceleration * 0.05 + 1e-12);
    before = now;
  }
}

TEST(Simulation, ActsOnACommandWhenTheLatencyIsOver) {
  SimulationParameters late;
  late.robot.latency = 0.15;
  Simulation simulation(room(), {1.0, 1.0, 1.57}, late);
  simulation.drive({0.5, 0.0}, 0.1);
  EXPECT_EQ(simulation.velocity().linear, 0.0);
  simulation.drive({0.0, 1.0}, 0.1);
  EXPECT_NEAR(simulation.velocity().linear, 0.05, 1e-9) << "50 ms of the first command";
  EXPECT_EQ(simulation.velocity().angular, 0.0);
  simulation.drive({0.0, 1.0}, 0.1);
  EXPECT_NEAR(simulation.velocity().linear, 0.05, 1e-9) << "up for 50 ms, and down again";
  EXPECT_NEAR(simulation.velocity().angular, 0.2, 1e-9);
}

TEST(Simulation, RecordsItsWayDenselyEnough) {
  Simulation simulation(room(), {1.0, 1.0, 1.57}, {});
  for (int i = 0; i < 30; ++i) simulation.drive({0.7, 0.4}, 1.0);
  const auto& way = simulation.trajectory();
  ASSERT_GT(way.size(), 100U);
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector2d step = way[i].T_map_robot.position() - way[i - 1].T_map_robot.position();
    EXPECT_LE(step.norm(), 0.1);
    EXPECT_GE(way[i].time, way[i - 1].time);
  }
}

TEST(Simulation, OdometryErrsWhileTheTruthStaysTheSame) {
  SimulationParameters noisy, perfect;
  perfect.odometry = {0.0, 0.0, 0.0};
  Simulation a(room(), {1.0, 1.0, 1.57}, noisy), b(room(), {1.0, 1.0, 1.57}, perfect);
  for (Simulation* simulation : {&a, &b}) {
    simulation->drive({0.3, 0.0}, 5.0);
    simulation->drive({0.3, -1.0}, 3.0);
  }
  EXPECT_EQ(a.T_map_robot().x, b.T_map_robot().x);
  EXPECT_EQ(a.T_map_robot().theta, b.T_map_robot().theta);
  EXPECT_NEAR((b.T_odom_robot().position() - b.T_map_robot().position()).norm(), 0.0, 1e-9);
  EXPECT_GT((a.T_odom_robot().position() - a.T_map_robot().position()).norm(), 1e-3);
}

TEST(Simulation, TheVelocityShownErrsByWhatTheOdometryMisreads) {
  SimulationParameters parameters;
  parameters.odometry.turn_noise_deg = parameters.odometry.drift_noise_deg = 0.0;
  Simulation simulation(room(), {1.0, 1.0, 0.0}, parameters);
  EXPECT_EQ(simulation.observe().velocity.linear, 0.0);
  double error = 0.0, largest = 0.0;
  for (int i = 0; i < 20; ++i) {
    simulation.drive({0.5, 0.0}, 0.1);
    const double off = simulation.observe().velocity.linear - simulation.velocity().linear;
    error += 0.1 * off;
    largest = std::max(largest, std::abs(off));
  }
  EXPECT_NEAR(simulation.T_odom_robot().x - simulation.T_map_robot().x, error, 1e-9);
  EXPECT_GT(largest, 0.02);
  EXPECT_LT(largest, 0.2);
}

TEST(Simulation, EqualSeedsGiveEqualScansAndOtherSeedsOthers) {
  SimulationParameters one, two;
  two.seed = 2;
  Simulation a(room(), {1.0, 1.0, 0.0}, one), b(room(), {1.0, 1.0, 0.0}, one),
      c(room(), {1.0, 1.0, 0.0}, two);
  const auto ranges = a.observe().scan.ranges;
  EXPECT_EQ(ranges, b.observe().scan.ranges);
  EXPECT_NE(ranges, c.observe().scan.ranges);
}

TEST(Simulation, RefusesToStartInAWallOrOutside) {
  EXPECT_THROW(Simulation(room(), {3.02, 1.0, 0.0}, {}), std::runtime_error);
  EXPECT_THROW(Simulation(room(), {-50.0, 1.0, 0.0}, {}), std::runtime_error);
  EXPECT_THROW(Simulation(room(), {0.2, 1.0, 0.0}, {}), std::runtime_error);
}

}  // namespace
}  // namespace cca::simulation_test
