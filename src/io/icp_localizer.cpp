// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/icp_localizer.hpp"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>

#include <cmath>
#include <optional>

#include "cca_mrpt/io/mrpt_scan.hpp"

namespace cca {
namespace {

constexpr double kRadiansPerDegree = M_PI / 180.0;
constexpr double kMatchedRange = 1000.0;  // m; the points' own limit: what is no return is unknown

void configure(mrpt::slam::CMetricMapBuilderICP& icp, const IcpParameters& p) {
  icp.setVerbosityLevel(mrpt::system::LVL_ERROR);
  mrpt::maps::CSimplePointsMap::TMapDefinition points;
  points.insertionOpts.minDistBetweenLaserPoints = static_cast<float>(p.point_spacing);
  points.insertionOpts.fuseWithExisting = false;
  points.insertionOpts.isPlanarMap = true;
  points.insertionOpts.addToExistingPointsMap = true;
  icp.ICP_options.mapInitializers.push_back(points);
  icp.ICP_options.matchAgainstTheGrid = false;
  icp.ICP_options.insertionLinDistance = p.insert_distance;
  icp.ICP_options.insertionAngDistance = p.insert_angle_deg * kRadiansPerDegree;
  icp.ICP_options.localizationLinDistance = 0.0;
  icp.ICP_options.localizationAngDistance = 0.0;
  icp.ICP_options.minICPgoodnessToAccept = p.least_goodness;
  auto& options = icp.ICP_params;
  options.ICP_algorithm = mrpt::slam::icpClassic;
  options.maxIterations = static_cast<unsigned>(p.iterations);
  options.minAbsStep_trans = 1e-5;
  options.minAbsStep_rot = 1e-5;
  options.thresholdDist = p.match_distance;
  options.thresholdAng = p.match_angle_deg * kRadiansPerDegree;
  options.ALFA = 0.8;
  options.smallestThresholdDist = p.smallest_match_distance;
  options.onlyUniqueRobust = true;
  options.corresponding_points_decimation = 2;
  options.doRANSAC = false;
  options.skip_cov_calculation = true;
}

}  // namespace

struct IcpLocalizer::Builder {
  Pose2 T_map_start;
  mrpt::slam::CMetricMapBuilderICP icp;
  std::optional<Pose2> last_odometry;
  double time = 0.0;  // s; logs may lack it, and the builder insists that it rises
};

IcpLocalizer::IcpLocalizer(const Pose2& T_map_start, const IcpParameters& parameters)
    : builder_(std::make_unique<Builder>()) {
  builder_->T_map_start = T_map_start;
  configure(builder_->icp, parameters);
  builder_->icp.initialize();
}

IcpLocalizer::~IcpLocalizer() = default;
IcpLocalizer::IcpLocalizer(IcpLocalizer&&) noexcept = default;
IcpLocalizer& IcpLocalizer::operator=(IcpLocalizer&&) noexcept = default;

Pose2 IcpLocalizer::locate(const Scan& scan, const Pose2& T_robot_sensor,
                           const Pose2& T_odom_robot) {
  const Pose2 moved =
      builder_->last_odometry ? builder_->last_odometry->inverse() * T_odom_robot : Pose2();
  builder_->last_odometry = T_odom_robot;
  mrpt::obs::CActionRobotMovement2D movement;
  builder_->time += 0.1;
  movement.timestamp = mrpt::Clock::fromDouble(builder_->time);
  movement.computeFromOdometry(mrpt::poses::CPose2D(moved.x, moved.y, moved.theta), {});
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<mrpt::obs::CObservation2DRangeScan>(
      toMrpt(scan, T_robot_sensor, kMatchedRange, builder_->time)));
  builder_->icp.processActionObservation(actions, frame);
  const mrpt::poses::CPose2D pose(builder_->icp.getCurrentPoseEstimation()->getMeanVal());
  return builder_->T_map_start * Pose2{pose.x(), pose.y(), wrapAngle(pose.phi())};
}

}  // namespace cca
