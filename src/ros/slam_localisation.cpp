// SPDX-License-Identifier: BSD-3-Clause
#include "slam_localisation.hpp"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "cca_mrpt/io/memory_file.hpp"
#include "cca_mrpt/ros/line_messages.hpp"
#include "cca_mrpt/ros/pose_message.hpp"
#include "node_main.hpp"

namespace cca {
namespace {

/// map -> odom changes slowly: it holds for so much longer than the scan that it was found with, so
/// that others can place what comes before the next scan. The same is amcl's default.
const ros::Duration kHolds(0.1);
const ros::WallDuration kPatience(5.0);  // localisations tell a pose with their first scans

}  // namespace

SlamLocalisation::SlamLocalisation(ros::NodeHandle& node, FrameNames frames,
                                   const std::string& resume)
    : frames_(std::move(frames)),
      transforms_(node.advertise<tf2_msgs::TFMessage>("/tf", 100)),
      poses_(node.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 10)),
      loop_markers_(node.advertise<visualization_msgs::MarkerArray>("loop_markers", 1, true)),
      others_(node.subscribe("/tf", 200, &SlamLocalisation::warnOfOthers, this)) {
  if (resume.empty()) return;
  const SlamMemory memory = seenFrom({0.0, 0.0}, loadMemory(resume));
  slam_.remember(memory);
  remember(memory, past_);
}

MapMemory SlamLocalisation::memory() const {
  SlamMemory memory;
  bool is_apart = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    memory = slam_.memory();
    is_apart = remembered() > 0 && !isInMemory();
  }
  return {packedMemory({std::move(memory)}), is_apart};
}

bool SlamLocalisation::place(PlacedScan& placed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_) past_.add(last_->scan, last_->T_fixed_robot, !pose_.is_lost);
  const Pose2 T_odom_robot = placed.T_fixed_robot;
  const Pose2 T_robot_sensor = placed.T_robot_sensor;
  const int version = pose_.version;
  pose_ = slam_.step(placed.scan, T_robot_sensor, T_odom_robot);
  T_map_odom_ = pose_.T_map_robot * T_odom_robot.inverse();
  placed.T_fixed_robot = pose_.T_map_robot;
  placed.scan.T_map_sensor = pose_.T_map_robot * T_robot_sensor;
  stamps_.push_back(placed.stamp.toSec());
  const bool is_corrected = pose_.version != version;
  if (is_corrected) past_.correct(slam_.trajectory(), slam_.isPlaced());
  publish(placed);
  if (is_corrected || loops() != loops_shown_) showLoops(placed.stamp);
  last_ = placed;
  return is_corrected;
}

bool SlamLocalisation::placeBeside(PlacedScan& placed) {
  if (!last_ || pose_.is_lost) return false;
  placed.T_fixed_robot = T_map_odom_ * placed.T_fixed_robot;
  placed.scan.T_map_sensor = T_map_odom_ * placed.scan.T_map_sensor;
  past_.addBeside(past_.size(), placed.scan, last_->T_fixed_robot, placed.topic);
  return true;
}

void SlamLocalisation::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!last_) return;
  const Pose2 T_odom_robot = T_map_odom_.inverse() * pose_.T_map_robot;
  past_.add(last_->scan, last_->T_fixed_robot, !pose_.is_lost);
  last_.reset();
  slam_.finish();
  const std::vector<Pose2> trajectory = slam_.trajectory();
  past_.correct(trajectory, slam_.isPlaced());
  pose_.T_map_robot = trajectory.back();
  T_map_odom_ = pose_.T_map_robot * T_odom_robot.inverse();
}

void SlamLocalisation::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  slam_ = Slam(pose_.T_map_robot);
  pose_ = {pose_.T_map_robot};
  past_ = {};
  last_.reset();
  stamps_.clear();
  showLoops(ros::Time::now());
}

std::vector<StampedPose> SlamLocalisation::way() const {
  const std::vector<Pose2> poses = slam_.trajectory();
  std::vector<StampedPose> way;
  for (std::size_t k = 0; k < stamps_.size(); ++k) {
    way.push_back({stamps_[k], poses[k + remembered()]});
  }
  return way;
}

void SlamLocalisation::tell(NodeDiagnostics& diagnostics) const {
  diagnostics.note("slam: agreement of the last scan", pose_.agreement);
  diagnostics.note("slam: loops closed", loops());
  diagnostics.note("slam: lost", pose_.is_lost);
  diagnostics.note("slam: found in the earlier map", remembered() > 0 && isInMemory());
  diagnostics.note("slam: corrections of the past", pose_.version);
}

void SlamLocalisation::publish(const PlacedScan& placed) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(1);
  auto& T_map_odom = transforms.transforms.front();
  T_map_odom.header.frame_id = frames_.map;
  T_map_odom.header.stamp = placed.stamp + kHolds;
  T_map_odom.child_frame_id = frames_.odom;
  T_map_odom.transform = transformMessage(T_map_odom_);
  transforms_.publish(transforms);

  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = frames_.map;
  pose.header.stamp = placed.stamp;
  pose.pose.pose = poseMessage(pose_.T_map_robot);
  constexpr int kRows[] = {0, 1, 5};  // x, y, yaw of a pose in space
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      pose.pose.covariance[static_cast<std::size_t>(6 * kRows[i] + kRows[j])] =
          pose_.covariance(i, j);
    }
  }
  poses_.publish(pose);
}

void SlamLocalisation::showLoops(const ros::Time& stamp) {
  std_msgs::Header header;
  header.frame_id = frames_.map;
  header.stamp = stamp;
  const PoseGraph& graph = slam_.keyFrames().graph;
  std::vector<Eigen::Vector2d> ends;
  for (const LoopVerdict& loop : slam_.loops()) {
    ends.push_back(graph.pose(loop.frame).position());
    ends.push_back(graph.pose(loop.candidate).position());
  }
  loop_markers_.publish(loopMarkers(ends, header));
  loops_shown_ = loops();
}

void SlamLocalisation::warnOfOthers(
    const ros::MessageEvent<const tf2_msgs::TFMessage>& event) const {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  for (const auto& transform : event.getMessage()->transforms) {
    if (frameName(transform.child_frame_id) != frameName(frames_.odom)) continue;
    ROS_WARN_THROTTLE(5.0, "%s tells where '%s' is, too: the robot will be seen in two places",
                      event.getPublisherName().c_str(), frames_.odom.c_str());
  }
}

std::string choosePose(ros::NodeHandle& node, const FrameNames& frames,
                       const std::function<void(const std::string&)>& tell) {
  const TransformFeed feed(node, [] {});
  const Transforms& tf = feed.transforms();
  ros::WallTime alone_since;
  while (keepRunning(0.1)) {
    const ros::WallTime now = ros::WallTime::now();
    if (tf.has(frames.map, frames.base, {})) return "tf";
    if (!tf.has(frames.odom, frames.base, {})) {
      alone_since = {};
      tell(tf.whyNot(frames.odom, frames.base));
      continue;
    }
    if (alone_since.isZero()) alone_since = now;
    if (now - alone_since > kPatience) return "slam";
    tell("for somebody who tells where '" + frames.odom + "' is");
  }
  return {};
}

}  // namespace cca
