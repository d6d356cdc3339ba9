// SPDX-License-Identifier: BSD-3-Clause
#include "peers/particle_slam.hpp"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMetricMapBuilderRBPF.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "io/poses/mrpt_steps.hpp"

namespace cca::peers {
namespace {

constexpr unsigned kParticles = 10;

/// As in MRPT's gridmapping_RBPF_ICPbased_intel.ini, with a pose for every scan.
mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions settings() {
  mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options;
  options.verbosity_level = mrpt::system::LVL_ERROR;
  options.insertionLinDistance = 2.0f;
  options.insertionAngDistance = static_cast<float>(30.0 * M_PI / 180.0);
  options.localizeLinDistance = options.localizeAngDistance = 0.0f;
  options.PF_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfOptimalProposal;
  options.PF_options.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
  options.PF_options.sampleSize = kParticles;
  options.PF_options.BETA = 0.5;
  options.PF_options.adaptiveSampleSize = false;
  mrpt::maps::CSimplePointsMap::TMapDefinition points;
  points.insertionOpts.minDistBetweenLaserPoints = 0.05f;
  points.insertionOpts.isPlanarMap = true;
  points.insertionOpts.addToExistingPointsMap = true;
  options.mapsInitializers.push_back(points);
  auto& prediction = options.predictionOptions;
  prediction.pfOptimalProposal_mapSelection = 3;  // points
  prediction.ICPGlobalAlign_MinQuality = 0.8f;
  prediction.icp_params.ICP_algorithm = mrpt::slam::icpLevenbergMarquardt;
  prediction.icp_params.maxIterations = 60;
  prediction.icp_params.ALFA = 0.5;
  prediction.icp_params.thresholdDist = 1.0;
  prediction.icp_params.thresholdAng = 5.0 * M_PI / 180.0;
  prediction.icp_params.smallestThresholdDist = 0.1;
  return options;
}

}  // namespace

/// Its start is the identity.
class ParticleFilter {
 public:
  ParticleFilter() : filter_(settings()) {
    mrpt::random::getRandomGenerator().randomize(1);
    filter_.mapPDF.setVerbosityLevel(mrpt::system::LVL_ERROR);
    filter_.initialize();
  }

  void step(const Scan& scan, const Pose2& T_robot_sensor,
            const std::optional<Pose2>& T_odom_robot) {
    auto [actions, frame] = steps_.next(scan, T_robot_sensor, T_odom_robot);
    filter_.processActionObservation(actions, frame);
    path_lengths_.push_back(path().size());
  }

  std::vector<Pose2> trajectory() const {
    const std::deque<mrpt::math::TPose3D> found = path();
    std::vector<Pose2> poses;
    for (const std::size_t length : path_lengths_) {
      const mrpt::math::TPose3D pose =
          found.empty() ? mrpt::math::TPose3D() : found[std::max<std::size_t>(length, 1) - 1];
      poses.push_back({pose.x, pose.y, wrapAngle(pose.yaw)});
    }
    return poses;
  }

 private:
  /// Of the likeliest particle.
  std::deque<mrpt::math::TPose3D> path() const {
    const auto& particles = filter_.mapPDF;
    std::size_t best = 0;
    for (std::size_t k = 1; k < particles.particlesCount(); ++k) {
      if (particles.getW(k) > particles.getW(best)) best = k;
    }
    std::deque<mrpt::math::TPose3D> path;
    particles.getPath(best, path);
    return path;
  }

  mrpt::slam::CMetricMapBuilderRBPF filter_;
  MrptSteps steps_;
  std::vector<std::size_t> path_lengths_;  ///< after each scan
};

ParticleSlam::ParticleSlam(const Pose2& T_map_start)
    : T_map_start_(T_map_start), filter_(std::make_unique<ParticleFilter>()) {}

ParticleSlam::~ParticleSlam() = default;

void ParticleSlam::step(const Scan& scan, const Pose2& T_robot_sensor,
                        const std::optional<Pose2>& T_odom_robot) {
  filter_->step(scan, T_robot_sensor, T_odom_robot);
}

std::vector<Pose2> ParticleSlam::trajectory() const {
  std::vector<Pose2> poses = filter_->trajectory();
  for (Pose2& pose : poses) pose = T_map_start_ * pose;
  return poses;
}

}  // namespace cca::peers
