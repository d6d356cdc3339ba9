// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/pose_files.hpp"

#include <algorithm>
#include <cmath>

#include "io/files/text.hpp"

namespace cca {
namespace {

bool tellsTimes(const std::vector<StampedPose>& poses) {
  return std::any_of(poses.begin(), poses.end(), [](const auto& pose) { return pose.time != 0.0; });
}

}  // namespace

std::string posesCsv(const std::vector<StampedPose>& poses) {
  const bool timed = tellsTimes(poses);
  std::string text = "stamp,x,y,theta\n";
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose2& pose = poses[k].T_map_robot;
    text += formatted("%.6f,%.6f,%.6f,%.8f\n", timed ? poses[k].time : static_cast<double>(k),
                      pose.x, pose.y, pose.theta);
  }
  return text;
}

std::string posesTum(const std::vector<StampedPose>& poses) {
  const bool timed = tellsTimes(poses);
  std::string text;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose2& pose = poses[k].T_map_robot;
    text += formatted("%.6f %.6f %.6f 0 0 0 %.8f %.8f\n",
                      timed ? poses[k].time : static_cast<double>(k), pose.x, pose.y,
                      std::sin(0.5 * pose.theta), std::cos(0.5 * pose.theta));
  }
  return text;
}

std::string graphG2o(const PoseGraph& graph) {
  std::string text;
  for (int k = 0; k < graph.size(); ++k) {
    const Pose2& pose = graph.pose(k);
    text += formatted("VERTEX_SE2 %d %.9g %.9g %.9g\n", k, pose.x, pose.y, pose.theta);
  }
  if (graph.size() > 0) text += "FIX 0\n";
  for (const GraphEdge& edge : graph.edges()) {
    const Eigen::Matrix3d& i = edge.information;
    text += formatted("EDGE_SE2 %d %d %.9g %.9g %.9g %.6g %.6g %.6g %.6g %.6g %.6g\n", edge.from,
                      edge.to, edge.T_from_to.x, edge.T_from_to.y, edge.T_from_to.theta, i(0, 0),
                      i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2));
  }
  return text;
}

}  // namespace cca
