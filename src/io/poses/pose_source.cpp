// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/pose_source.hpp"

#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"

namespace cca {

std::unique_ptr<Localiser> makeLocaliser(PoseSource source, const IcpParameters& icp) {
  switch (source) {
    case PoseSource::kOdometry:
      return std::make_unique<WheelOdometry>();
    case PoseSource::kIcp:
      return std::make_unique<IcpLocaliser>(icp);
    case PoseSource::kSlam:
      return std::make_unique<SlamLocaliser>();
    default:
      return std::make_unique<GivenPoses>();
  }
}

}  // namespace cca
