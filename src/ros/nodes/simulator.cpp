// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt simulator _world:=FILE.yaml: a robot in MRPT's world. It takes `cmd_vel`, and
// gives `scan`, `odom`, tf and, with simulated time, `/clock`.
#include <geometry_msgs/Twist.h>

#include <cmath>

#include "node_main.hpp"
#include "ros/driving/pace.hpp"
#include "ros/driving/simulated_robot.hpp"
#include "ros/parameters/private_parameters.hpp"
#include "ros/parameters/simulator_parameters.hpp"

namespace cca {
namespace {

constexpr double kCommandHolds = 0.5;  // s; a base that hears nothing for longer stops

struct Settings {
  SimulatorParameters simulator;
  FrameNames frames;
  bool localisation = true;
  Parameters program;
};

Settings readSettings() {
  Settings s;
  PrivateParameters parameters{ros::NodeHandle("~")};
  parameters.text("world", s.simulator.world);
  readParameters(parameters, s.simulator, s.program);
  parameters.flag("localisation", s.localisation);
  parameters.frame("odom_frame", s.frames.odom);
  parameters.frame("map_frame", s.frames.map, s.localisation ? s.frames.odom : "");
  parameters.frame("base_frame", s.frames.base);
  parameters.frame("laser_frame", s.frames.laser);
  parameters.program(s.program, {"robot", "laser", "odometry"});
  parameters.refuseUnknown();
  return s;
}

void simulate() {
  const Settings settings = readSettings();
  ros::NodeHandle node;
  SimulatedRobot robot(node, makeSimulation(settings.simulator, settings.program),
                       {settings.frames, settings.simulator.scan_rate, settings.simulator.record,
                        settings.localisation});
  Velocity command;
  double commanded_at = -kCommandHolds;
  const auto take = [&](const geometry_msgs::Twist::ConstPtr& twist) {
    if (!std::isfinite(twist->linear.x) || !std::isfinite(twist->angular.z)) {
      ROS_WARN_THROTTLE(5.0, "cmd_vel that is not finite: ignored");
      return;
    }
    command = {twist->linear.x, twist->angular.z};
    commanded_at = robot.simulation().time();
  };
  const ros::Subscriber commands = node.subscribe<geometry_msgs::Twist>(
      "cmd_vel", 1, take, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  Pace pace(settings.simulator.speed);
  int collisions = 0;
  while (pace.wait(robot.simulation().time() + robot.tickPeriod())) {
    robot.skip(pace.forgive(robot.simulation().time()));
    const bool heard = robot.simulation().time() - commanded_at < kCommandHolds;
    robot.tick(heard ? command : Velocity{});
    if (robot.scanIsDue()) robot.scan();
    if (robot.simulation().collisions() > collisions) {
      collisions = robot.simulation().collisions();
      ROS_ERROR("collision number %d at %.2f, %.2f", collisions, robot.simulation().T_map_robot().x,
                robot.simulation().T_map_robot().y);
    }
  }
}

const NodeDescription kNode{
    "simulator",
    "a robot in a simulated world: cmd_vel in; scan, odom, tf out\n\n"
    "_name:=value [default]\n"
    "  world map_server YAML file, or the name of one in maps/; must be given\n"
    "  config [] .ini file, read first\n" +
        simulatorHelp() +
        "\n"
        "  record [] bag to write\n"
        "  localisation [true] tells map -> odom, which is the truth; false: nobody here does\n"
        "  map_frame [map], odom_frame [odom], base_frame [base_link], laser_frame [laser]",
    {"robot", "laser", "odometry"}};

}  // namespace
}  // namespace cca

int main(int argc, char** argv) { return cca::runNode(argc, argv, cca::kNode, cca::simulate); }
