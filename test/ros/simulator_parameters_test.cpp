// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters/simulator_parameters.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

/// m, how far the odometry of a short drive is off.
double odometryError(double distance_noise) {
  SimulatorParameters simulator;
  simulator.world = CCA_MAPS_FOLDER "/two_rooms.yaml";
  Parameters program;
  program.odometry = {distance_noise, 0.0, 0.0};
  Simulation simulation = makeSimulation(simulator, program);
  for (int k = 0; k < 20; ++k) simulation.drive({0.5, 0.0}, 0.1);
  return (simulation.T_odom_robot().position() - simulation.T_map_robot().position()).norm();
}

TEST(SimulatorParameters, TheProgramsOdometryIsTheRobots) {
  EXPECT_NEAR(odometryError(0.0), 0.0, 1e-9);
  EXPECT_GT(odometryError(0.5), 0.01);
}

}  // namespace
}  // namespace cca
