// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt explore [_world:=FILE.yaml _strategy:=NAME]: explores a simulated world in one
// process; with `_world:=none`, explores with a robot that has `scan`, tf and `cmd_vel`.
#include <filesystem>
#include <stdexcept>

#include "cca_mrpt/localisation/given_poses.hpp"
#include "exploration.hpp"
#include "io/files/memory_file.hpp"
#include "io/plans/plan_reader.hpp"
#include "node_diagnostics.hpp"
#include "node_localisation.hpp"
#include "node_main.hpp"
#include "ros/bags/topic_recorder.hpp"
#include "ros/driving/goal_server.hpp"
#include "ros/driving/pace.hpp"
#include "ros/driving/robot_driver.hpp"
#include "ros/driving/simulated_robot.hpp"
#include "ros/parameters/private_parameters.hpp"
#include "ros/parameters/simulator_parameters.hpp"

namespace cca {
namespace {

constexpr const char* kNoWorld = "none";  // the robot is out there

struct Settings {
  SimulatorParameters simulator;
  RobotDriver::Settings driver;
  Exploration::Settings exploration;
  std::string record;  ///< bag to write, of a robot that is out there
  bool exit_at_end = false;
  Parameters program;
};

Settings readSettings() {
  Settings s;
  s.simulator.world = "two_rooms";
  PrivateParameters parameters{ros::NodeHandle("~")};
  parameters.text("world", s.simulator.world);
  std::vector<std::string> sections{"mapping", "exploration", "robot"};
  if (s.simulator.world == kNoWorld) {
    s.program.robot.latency = RobotParameters::kLatencyOutThere;
    const auto [shortest, longest] = RobotDriver::kScanTimeouts;
    parameters.number("scan_timeout", s.driver.scan_timeout, shortest, longest, "s");
    parameters.text("resume", s.driver.resume);
    parameters.text("plan", s.driver.plan);
    parameters.flag("corrections", s.driver.corrections);
    parameters.names("scans", s.driver.scans);
    parameters.topic("hazard_points", s.driver.hazard_points);
    parameters.topic("hazard_range", s.driver.hazard_range);
    parameters.choice("driver", s.driver.driver, {"cmd_vel", "move_base"});
    parameters.choice("pose", s.driver.pose, {"tf", "slam", "auto", "odometry"});
    parameters.text("record", s.record);
    for (const char* simulated : {"start_pose", "speed", "laser_model", "scan_rate", "seed"}) {
      parameters.withoutEffect(simulated);
    }
  } else {
    readParameters(parameters, s.simulator, s.program);
    sections.insert(sections.end(), {"laser", "odometry"});
    for (const char* robots : {"scan_timeout", "pose", "resume", "plan", "corrections", "scans",
                               "hazard_points", "hazard_range", "driver"}) {
      parameters.withoutEffect(robots);
    }
  }
  const bool is_told =
      s.simulator.world == kNoWorld && (s.driver.pose == "tf" || s.driver.pose == "auto");
  if (!s.driver.plan.empty() && !is_told) {
    throw std::runtime_error("parameter ~plan needs _pose:=tf: it lies where localizer has it");
  }
  parameters.frame("odom_frame", s.driver.frames.odom);
  parameters.frame("map_frame", s.driver.frames.map, is_told ? "" : s.driver.frames.odom);
  parameters.frame("base_frame", s.driver.frames.base);
  parameters.frame("laser_frame", s.driver.frames.laser);
  parameters.text("labels", s.exploration.labels);
  parameters.path("out", s.exploration.out, "a folder");
  parameters.flag("autostart", s.exploration.autostart);
  parameters.flag("save_at_end", s.exploration.save_at_end);
  parameters.flag("exit_at_end", s.exit_at_end);
  s.exploration.page.read(parameters);
  s.exploration.page.has_robot = true;
  parameters.program(s.program, sections);
  parameters.refuseUnknown();
  s.driver.robot = s.program.robot;
  s.exploration.map_frame = s.driver.frames.map;
  s.exploration.page.robot_radius = s.program.robot.radius;
  s.exploration.page.title = s.simulator.world == kNoWorld
                                 ? "exploration"
                                 : std::filesystem::path(s.simulator.world).stem().string();
  return s;
}

void exploreSimulated(Settings settings, ros::NodeHandle& node, ros::NodeHandle& private_node) {
  SimulatedRobot robot(
      node, makeSimulation(settings.simulator, settings.program),
      {settings.driver.frames, settings.simulator.scan_rate, settings.simulator.record, true});
  settings.exploration.page.world = replayWorld(robot.simulation().world());
  Exploration exploration(node, private_node, settings.exploration, settings.program);
  exploration.begin(std::make_unique<GivenPoses>());
  const GoalServer goals(node, private_node, settings.driver.frames.map, exploration);
  const NodeDiagnostics::Dropped none_dropped;
  NodeDiagnostics diagnostics(node, private_node, none_dropped);
  Pace pace(settings.simulator.speed);
  Velocity velocity;
  while (pace.wait(robot.simulation().time())) {
    robot.skip(pace.forgive(robot.simulation().time()));
    if (robot.scanIsDue()) {
      const ros::WallTime begin = ros::WallTime::now();
      const Observation seen = robot.scan();
      const Measurement measurement = measurementOf(seen, robot.simulation().scanned().T_odom_robot,
                                                    robot.simulation().sweepMotion());
      velocity = exploration.step(exploration.sense(measurement, seen.velocity), robot.now());
      diagnostics.scanUsed((ros::WallTime::now() - begin).toSec(), exploration.agreement());
      diagnostics.setState(exploration.state());
    }
    robot.tick(exploration.drives() ? velocity : Velocity{});
    if (exploration.finished() && settings.exit_at_end) break;
  }
  exploration.end();
}

void exploreWithRobot(Settings settings, ros::NodeHandle& node, ros::NodeHandle& private_node) {
  RobotDriver::Settings& driver = settings.driver;
  std::set<std::string> topics = topicsOfRobot(driver.scans);
  topics.insert({driver.hazard_points, driver.hazard_range});
  const TopicRecorder recorder(node, settings.record, topics);
  Exploration exploration(node, private_node, settings.exploration, settings.program);
  std::optional<GoalServer> goals;  // where move_base drives, it takes them itself
  if (driver.driver != "move_base") {
    goals.emplace(node, private_node, driver.frames.map, exploration);
  }
  // At once, where they cannot be read, and not when tf is there.
  if (!driver.plan.empty()) driver.plan_lines = readPlan(driver.plan).lines;
  if (!driver.resume.empty()) static_cast<void>(loadMemory(driver.resume));
  if (driver.pose == "auto") {
    driver.pose =
        choosePose(node, driver.frames, [&](const std::string& what) { exploration.wait(what); });
  }
  if (!driver.pose.empty()) {
    RobotDriver robot(node, private_node, driver, settings.program.mapping, exploration);
    while (keepRunning(0.1)) {
      if (exploration.finished() && settings.exit_at_end) break;
    }
  }
  exploration.end();
}

void explore() {
  ros::NodeHandle node, private_node("~");
  const Settings settings = readSettings();
  if (settings.simulator.world == kNoWorld) {
    exploreWithRobot(settings, node, private_node);
  } else {
    exploreSimulated(settings, node, private_node);
  }
}

const NodeDescription kNode{
    "explore",
    "explores a simulated world, or with a robot that is out there (_world:=none)\n\n"
    "_name:=value [default]\n"
    "  world [two_rooms] map_server YAML file, or the name of one in maps/; none: the robot's\n"
    "  config [] .ini file, read first\n"
    "  autostart [true] false: waits for the service ~start\n"
    "  out [cca_map] folder for the map\n"
    "  save_at_end [true], exit_at_end [false]\n"
    "  labels [] CSV of x, y and name: names of rooms\n"
    "  record [] bag to write\n"
    "  map_frame [map], odom_frame [odom], base_frame [base_link], laser_frame [laser]\n"
    "  serve [false] shows the run in browsers, and obeys them; serve_port [8048] 0: any free;\n"
    "    serve_address [127.0.0.1] others: who asks must know a random token\n"
    "with a robot\n"
    "  pose [tf] tf: somebody gives map -> odom; slam: this node does, by line SLAM; odometry:\n"
    "    this node does, and trusts the wheels; auto: slam where nobody gives it for 5 s, else tf\n"
    "  driver [cmd_vel] who drives; move_base: its action is sent the explorer's goals\n"
    "  robot/latency [0.15] s, from a command to where the base acts on it; 0 in a simulated "
    "world\n"
    "  resume [] folder of an earlier map with map.slam: slam goes on with it\n"
    "  plan [] what localizer takes as its plan: the ways of it are known\n"
    "  corrections [true] the past is placed anew where tf's map -> odom leaps, or by "
    "corrected_path\n"
    "  scans [[scan]] topics of its lasers; it drives by the first, and not into what any sees\n"
    "  hazard_points [] topic, PointCloud2: what bumpers and the like have met\n"
    "  hazard_range [] topic, Range: the same of distance sensors\n"
    "  scan_timeout [0.3] s without a usable scan until the robot is stopped\n"
    "in a simulated world\n" +
        simulatorHelp(),
    {"mapping", "exploration", "robot", "laser", "odometry"}};

}  // namespace
}  // namespace cca

int main(int argc, char** argv) { return cca::runNode(argc, argv, cca::kNode, cca::explore); }
