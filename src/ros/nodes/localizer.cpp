// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt localizer _plan:=FILE: `scan` and odometry in, map -> odom and `amcl_pose` out,
// in a finished map or a drawn plan, which stays as it is.
#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include <stdexcept>

#include "cca_mrpt/known_map/known_map.hpp"
#include "io/plans/plan_reader.hpp"
#include "known_map/global_localisation.hpp"
#include "known_map/plan_sight.hpp"
#include "node_diagnostics.hpp"
#include "node_localisation.hpp"
#include "node_main.hpp"
#include "ros/input/scan_feed.hpp"
#include "ros/input/transforms.hpp"
#include "ros/messages/pose_message.hpp"
#include "ros/output/line_publisher.hpp"
#include "ros/output/pose_publisher.hpp"
#include "ros/parameters/private_parameters.hpp"
#include "sensing/motion_compensation.hpp"

namespace cca {
namespace {

constexpr double kFarthestOff = 100.0;  // m; 2-D lasers see the plan's walls from no farther

struct LocalizerParameters {
  FrameNames frames;
  std::vector<std::string> scans{"scan"};
  std::string plan;
  double scale = 0.0;  ///< m a unit of the drawing; 0: as it tells
};

LocalizerParameters readLocalizerParameters(const ros::NodeHandle& private_node) {
  LocalizerParameters p;
  PrivateParameters parameters(private_node);
  parameters.names("scans", p.scans);
  parameters.text("plan", p.plan);
  parameters.number("scale", p.scale, 0.0, 1e6, "m a unit");
  parameters.frame("odom_frame", p.frames.odom);
  parameters.frame("map_frame", p.frames.map, p.frames.odom);
  parameters.frame("base_frame", p.frames.base);
  parameters.refuseUnknown();
  if (p.plan.empty()) {
    throw std::runtime_error(
        "parameter ~plan: is not given; it names the map or plan to localise in");
  }
  if (p.scans.size() != 1) {
    throw std::runtime_error("parameter ~scans: one laser localises, " +
                             std::to_string(p.scans.size()) + " are given");
  }
  return p;
}

class Localizer {
 public:
  explicit Localizer(ros::NodeHandle node = {}, ros::NodeHandle private_node = ros::NodeHandle("~"))
      : parameters_(readLocalizerParameters(private_node)),
        plan_(readPlan(parameters_.plan, parameters_.scale)),
        bounds_(boundsOf(plan_.lines)),
        localiser_(plan_.lines, plan_.sigmas),
        lines_(node, parameters_.frames.map),
        pose_(node, parameters_.frames, "amcl_pose"),
        scans_(node,
               {parameters_.scans,
                {parameters_.frames.odom, parameters_.frames.base, "", std::nullopt,
                 parameters_.frames.odom}},
               [this](const PlacedScan& scan) { localise(scan); }),
        diagnostics_(node, private_node, scans_.dropped()),
        initial_pose_(node.subscribe("initialpose", 1, &Localizer::place, this)) {
    lines_.publish(mapLinesOf(plan_.lines), ros::Time::now());
    ROS_INFO("%zu lines of %s (%s)", plan_.lines.size(), parameters_.plan.c_str(),
             plan_.kind.c_str());
    if (!plan_.not_understood.empty()) {
      ROS_WARN("%s also holds %s, which is no line", parameters_.plan.c_str(),
               plan_.not_understood.c_str());
    }
    diagnostics_.setState("not localised");
  }

 private:
  void localise(const PlacedScan& scan) {
    const ros::WallTime start = ros::WallTime::now();
    Measurement measurement = measurementOf(scan, true);
    measurement.scan = compensation_.undistort(measurement.scan, measurement.motion);
    measurement.undone = compensation_.undone();
    const Estimate estimate = localiser_.localise(measurement);
    tell(estimate.is_known);
    // Nobody is told a guess: map -> odom grows old, and who drives by it stops.
    if (estimate.is_known) pose_.publish(estimate, *measurement.T_odom_robot, scan.stamp);
    const SightShares& seen = localiser_.seen();
    if (estimate.is_known) {
      agreement_.add({static_cast<int>(seen.explained), static_cast<int>(seen.through)});
      diagnostics_.note("plan: share of returns explained",
                        seen.count() > 0.0 ? seen.explained / seen.count() : 0.0);
      diagnostics_.note("plan: residual [m]", localiser_.residual());
    }
    diagnostics_.note("plan: localised", estimate.is_known);
    diagnostics_.note("plan: times lost", localiser_.timesLost());
    diagnostics_.note("plan: places that may be",
                      static_cast<double>(localiser_.global().hypotheses().size()));
    diagnostics_.scanUsed((ros::WallTime::now() - start).toSec(), agreement_);
  }

  void tell(bool is_localised) {
    diagnostics_.setState(is_localised ? "localised" : "not localised");
    if (!is_localised) {
      ROS_WARN_THROTTLE(10.0, "not localised: looking for the robot in the whole of %s",
                        parameters_.plan.c_str());
    } else if (!was_localised_) {
      ROS_INFO("localised in %s", parameters_.plan.c_str());
    }
    was_localised_ = is_localised;
  }

  void place(const geometry_msgs::PoseWithCovarianceStamped& message) {
    if (frameName(message.header.frame_id) != frameName(parameters_.frames.map)) {
      ROS_WARN("initialpose is in '%s', not in '%s': not heeded", message.header.frame_id.c_str(),
               parameters_.frames.map.c_str());
      return;
    }
    const Pose2 told = flatPose(message.pose.pose);
    const auto& given = message.pose.covariance;
    Eigen::Vector3d variances(given[0], given[7], given[35]);
    if (!isFinite(told) || !variances.allFinite()) {
      ROS_WARN("initialpose is not finite: not heeded");
      return;
    }
    if (bounds_.exteriorDistance(told.position()) > kFarthestOff) {
      ROS_WARN("initialpose is %.0f m beside the plan: not heeded",
               bounds_.exteriorDistance(told.position()));
      return;
    }
    // Who tells no covariance points with a mouse: rviz's own default.
    if (variances.minCoeff() <= 0.0) variances = {0.25, 0.25, 0.07};
    localiser_.place({told.x, told.y, wrapAngle(told.theta)}, variances.asDiagonal());
  }

  LocalizerParameters parameters_;
  PlanFile plan_;
  Eigen::AlignedBox2d bounds_;  ///< m, map frame: of the plan
  KnownMap localiser_;
  MotionCompensation compensation_;
  ScanAgreement agreement_;
  bool was_localised_ = false;
  LinePublisher lines_;
  PosePublisher pose_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  ros::Subscriber initial_pose_;
};

const NodeDescription kLocalizerNode{
    "localizer",
    "where the robot is in a finished map or a drawn plan, which stays as it is\n\n"
    "_name:=value [default]\n"
    "  plan [] folder of a map, lines.csv, map.slam, .geojson, .dxf, .svg, or\n"
    "    the .yaml of a map_server grid\n"
    "  scale [0] metres of a unit of the drawing; 0: as it tells\n"
    "  scans [[scan]] topic of the laser\n"
    "  map_frame [map], odom_frame [odom], base_frame [base_link]",
    {}};

}  // namespace
}  // namespace cca

int main(int argc, char** argv) {
  return cca::runNode(argc, argv, cca::kLocalizerNode, [] {
    const cca::Localizer localizer;
    while (cca::keepRunning(0.1)) {
    }
  });
}
