// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt check_robot: listens to a robot for a while, and says what exploring and mapping
// with it lack, with the parameter that mends it. It sends nothing: the robot does not move.
#include <geometry_msgs/Twist.h>
#include <ros/master.h>

#include <cstdio>

#include "node_main.hpp"
#include "ros/driving/robot_check.hpp"
#include "ros/input/scan_feed.hpp"
#include "ros/input/transform_feed.hpp"
#include "ros/parameters/private_parameters.hpp"

namespace cca {
namespace {

constexpr double kShortest = 1.0, kLongest = 600.0;  // s

struct Settings {
  RobotCheck::Settings check;
  double seconds = 20.0;
};

Settings readSettings() {
  Settings s;
  PrivateParameters parameters{ros::NodeHandle("~")};
  parameters.number("seconds", s.seconds, kShortest, kLongest, "s");
  parameters.frame("map_frame", s.check.map_frame);
  parameters.frame("odom_frame", s.check.odom_frame);
  parameters.frame("base_frame", s.check.base_frame);
  Parameters program;
  parameters.program(program, {"robot"});
  parameters.refuseUnknown();
  s.check.radius = program.robot.radius;
  return s;
}

/// Topics of these types that somebody publishes.
std::string published(const std::vector<std::string>& types) {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::string names;
  for (const ros::master::TopicInfo& topic : topics) {
    if (std::find(types.begin(), types.end(), topic.datatype) == types.end()) continue;
    names += " " + topic.name;
  }
  return names;
}

/// @param what  is wrong; empty: nothing came.
void tellSilent(const std::string& topic, const std::vector<std::string>& types, std::string what,
                Findings& findings) {
  const std::string others = published(types);
  if (what.empty()) what = "nothing came by " + ros::names::resolve(topic);
  findings.fault(topic + ": " + what, others.empty() ? "start what publishes " + types.front()
                                                     : topic + ":= one of" + others);
}

const char* nameOf(Finding::Kind kind) {
  return kind == Finding::Kind::kGood ? "good " : kind == Finding::Kind::kNote ? "note " : "FAULT";
}

/// @return  whether there is no fault.
bool report(const Findings& findings) {
  int faults = 0;
  for (const Finding& finding : findings) {
    std::printf("%s  %s\n", nameOf(finding.kind), finding.what.c_str());
    if (!finding.remedy.empty()) std::printf("         -> %s\n", finding.remedy.c_str());
    faults += finding.kind == Finding::Kind::kFault;
  }
  std::printf("%d fault(s)\n", faults);
  std::fflush(stdout);
  return faults == 0;
}

template <class Message, class Take>
ros::Subscriber hear(ros::NodeHandle& node, const char* topic, std::uint32_t queue,
                     const Take& take) {
  return node.subscribe<Message, const ros::MessageEvent<const Message>&>(topic, queue, take);
}

/// @return  whether the robot is fit.
bool check() {
  const Settings settings = readSettings();
  RobotCheck check(settings.check);
  ros::NodeHandle node;
  const TransformFeed tf(node, [] {});
  std::string no_scan;
  const auto takeScan = [&](const ros::MessageEvent<const topic_tools::ShapeShifter>& event) {
    try {
      check.take(scanOf(*event.getConstMessage()), event.getReceiptTime());
    } catch (const std::runtime_error& error) {
      no_scan = error.what();
    }
    const auto pose = tf.transforms().latest(settings.check.odom_frame, settings.check.base_frame);
    if (pose && !pose->isZero()) check.takePoseAge((event.getReceiptTime() - *pose).toSec());
  };
  const auto takeTransforms = [&](const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
    check.take(*event.getConstMessage(), event.getPublisherName());
  };
  const auto takeOdometry = [&](const nav_msgs::Odometry::ConstPtr& m) { check.take(*m); };
  const auto scan = hear<topic_tools::ShapeShifter>(node, "scan", 100, takeScan);
  const auto odometry = node.subscribe<nav_msgs::Odometry>("odom", 100, takeOdometry);
  const auto transforms = hear<tf2_msgs::TFMessage>(node, "/tf", 1000, takeTransforms);
  const auto fixed = hear<tf2_msgs::TFMessage>(node, "/tf_static", 1000, takeTransforms);
  const ros::Publisher commands = node.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  const ros::WallTime begin = ros::WallTime::now();
  double left = settings.seconds;
  std::printf("listening for %.0f s; drive and turn the robot by hand, if you can\n", left);
  std::fflush(stdout);
  while (left > 0.0 && keepRunning(0.1)) {
    left = settings.seconds - (ros::WallTime::now() - begin).toSec();
  }
  if (ros::Time::isSimTime() && ros::Time::now().isZero()) {
    Findings no_clock;
    no_clock.fault("clock: use_sim_time is true, and nothing gives /clock",
                   "rosparam set use_sim_time false, if no simulation or bag is to give it");
    return report(no_clock);
  }
  Findings findings = check.findings(tf.transforms());
  if (check.scans() == 0) {
    tellSilent("scan", {"sensor_msgs/LaserScan", "sensor_msgs/MultiEchoLaserScan"}, no_scan,
               findings);
  }
  if (!check.hasOdometry()) tellSilent("odom", {"nav_msgs/Odometry"}, "", findings);
  if (commands.getNumSubscribers() > 0) {
    findings.good("cmd_vel: somebody listens");
  } else {
    findings.fault("cmd_vel: nobody listens to " + ros::names::resolve("cmd_vel"),
                   "cmd_vel:= the topic that the base listens to (rostopic list -s)");
  }
  return report(findings);
}

const NodeDescription kNode{
    "check_robot",
    "listens to scan, odom and tf, and says what exploring with this robot\n"
    "lacks, with the parameter that mends it. It sends nothing. Status 1: there\n"
    "are faults\n\n"
    "_name:=value [default]\n"
    "  seconds [20] of the wall's clock\n"
    "  map_frame [map], odom_frame [odom], base_frame [base_link]",
    {"robot"}};

}  // namespace
}  // namespace cca

int main(int argc, char** argv) {
  bool is_fit = true;
  const int status = cca::runNode(argc, argv, cca::kNode, [&] { is_fit = cca::check(); });
  return status != 0 ? status : is_fit ? 0 : 1;
}
