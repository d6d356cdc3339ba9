// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/particle_slam.hpp"

#include "icp_matcher.hpp"
#include "io/files/late_library.hpp"

namespace cca {

ParticleSlam::ParticleSlam(const Pose2& T_map_start) : T_map_start_(T_map_start) {
  using Make = ParticleFilter*();
  filter_.reset(reinterpret_cast<Make*>(lateFunction(kIcpLibrary, "makeParticleFilter"))());
}

std::vector<Pose2> ParticleSlam::trajectory() const {
  std::vector<Pose2> poses = filter_->trajectory();
  for (Pose2& pose : poses) pose = T_map_start_ * pose;
  return poses;
}

}  // namespace cca
