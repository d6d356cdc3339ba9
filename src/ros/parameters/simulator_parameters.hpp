// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "private_parameters.hpp"
#include "ros/driving/simulated_robot.hpp"

namespace cca {

/// What a node needs to simulate a robot.
struct SimulatorParameters {
  std::string world;        ///< a file, or the name of one in the package's maps/
  std::string start_pose;   ///< "X,Y,DEG"; empty: the world's own, else the widest place
  double speed = 1.0;       ///< simulated seconds a second of the wall
  double scan_rate = 10.0;  ///< Hz
  int seed = 1;
  std::string record;  ///< bag to write; empty: none
};

/// Reads them from the node's private parameters, but for the world.
/// @param program  its laser becomes that of ~laser_model.
void readParameters(PrivateParameters& parameters, SimulatorParameters& p, Parameters& program);

/// What --help tells of them, but for world and record; without an end of line.
std::string simulatorHelp();

/// @throws std::runtime_error for a world or start that cannot be, and for a speed other than 1
///         without simulated time: the stamps would run away from everybody else's clock.
Simulation makeSimulation(const SimulatorParameters& p, const Parameters& program);

}  // namespace cca
