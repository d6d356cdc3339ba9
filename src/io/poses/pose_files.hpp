// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"
#include "cca_mrpt/slam/pose_graph.hpp"

namespace cca {

/// A pose and when it was; s, as the log tells it.
struct StampedPose {
  double time = 0.0;
  Pose2 T_map_robot;
};

/// `stamp,x,y,theta` (s, m, m, rad), a row a pose, in their order. Where the log tells no times at
/// all, the stamps are the scans' numbers.
std::string posesCsv(const std::vector<StampedPose>& poses);

/// The same as the TUM RGB-D tools read it: `stamp x y z qx qy qz qw`.
std::string posesTum(const std::vector<StampedPose>& poses);

/// A pose graph as g2o, GTSAM, slam_toolbox and others read it: VERTEX_SE2, EDGE_SE2.
std::string graphG2o(const PoseGraph& graph);

}  // namespace cca
