// SPDX-License-Identifier: BSD-3-Clause
#include "icp_matcher.hpp"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>

#include <optional>

#include "mrpt_steps.hpp"

namespace cca {
namespace {

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

class MrptIcpMatcher : public IcpMatcher {
 public:
  explicit MrptIcpMatcher(const IcpParameters& parameters) {
    configure(icp_, parameters);
    icp_.initialize();
  }

  Pose2 locate(const Scan& scan, const Pose2& T_robot_sensor,
               const std::optional<Pose2>& T_odom_robot) override {
    auto [actions, frame] = steps_.next(scan, T_robot_sensor, T_odom_robot);
    icp_.processActionObservation(actions, frame);
    const mrpt::poses::CPose2D pose(icp_.getCurrentPoseEstimation()->getMeanVal());
    return {pose.x(), pose.y(), wrapAngle(pose.phi())};
  }

 private:
  mrpt::slam::CMetricMapBuilderICP icp_;
  MrptSteps steps_;
};

}  // namespace
}  // namespace cca

extern "C" cca::IcpMatcher* makeIcpMatcher(const cca::IcpParameters& parameters) {
  return new cca::MrptIcpMatcher(parameters);
}
