// SPDX-License-Identifier: BSD-3-Clause
#include "simulator_parameters.hpp"

#include <ros/package.h>
#include <ros/time.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "cca_mrpt/simulation/laser_models.hpp"

namespace cca {
namespace {

std::string worldFile(const std::string& world) {
  if (std::filesystem::is_regular_file(world)) return world;
  const std::string maps = ros::package::getPath("cca_mrpt") + "/maps/";
  for (const std::string& candidate : {maps + world, maps + world + ".yaml"}) {
    if (std::filesystem::is_regular_file(candidate)) return candidate;
  }
  throw std::runtime_error("parameter ~world = '" + world +
                           "' must be a map_server YAML file, or " + "the name of one in " + maps);
}

Pose2 parseStart(const std::string& text) {
  std::istringstream in(text);
  Pose2 pose;
  char first = 0, second = 0;
  double degrees = 0.0;
  const bool read = static_cast<bool>(in >> pose.x >> first >> pose.y >> second >> degrees);
  if (!read || first != ',' || second != ',' || !(in >> std::ws).eof()) {
    throw std::runtime_error("parameter ~start_pose = '" + text +
                             "' must be X,Y,DEG in metres and degrees");
  }
  pose.theta = wrapAngle(degrees * M_PI / 180.0);
  return pose;
}

}  // namespace

void readParameters(PrivateParameters& parameters, SimulatorParameters& p, Parameters& program) {
  std::string model = laserModels().front().name;
  std::vector<std::string> models;
  for (const LaserModel& one : laserModels()) models.push_back(one.name);
  parameters.choice("laser_model", model, models);
  program.laser = laserModel(model).laser;
  p.scan_rate = laserModel(model).rate;
  parameters.text("start_pose", p.start_pose);
  parameters.number("speed", p.speed, 0.01, 1000.0, "times real time");
  parameters.number("scan_rate", p.scan_rate, 1.0, 100.0, "Hz");
  parameters.number("seed", p.seed, 0, 1000000000, "");
  parameters.text("record", p.record);
}

std::string simulatorHelp() {
  return "  start_pose [the world's] X,Y,DEG\n"
         "  speed [1] simulated seconds a second; other than 1 needs /use_sim_time\n"
         "  laser_model [ld19] a laser by name: " +
         laserModelNames() +
         "\n  scan_rate [10, or the laser's own] Hz\n"
         "  seed [1] of all that is random";
}

Simulation makeSimulation(const SimulatorParameters& p, const Parameters& program) {
  if (p.speed != 1.0 && !ros::Time::isSimTime()) {
    throw std::runtime_error("parameter ~speed must be 1 unless /use_sim_time is true");
  }
  World world = loadWorld(worldFile(p.world));
  const Pose2 T_map_start =
      p.start_pose.empty() ? defaultStart(world, program.robot.radius) : parseStart(p.start_pose);
  SimulationParameters simulation;
  simulation.robot = program.robot;
  simulation.laser = program.laser;
  simulation.odometry = program.odometry;
  simulation.seed = static_cast<std::uint64_t>(p.seed);
  return Simulation(std::move(world), T_map_start, simulation);
}

}  // namespace cca
