// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/past_scans.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace cca {
namespace {

constexpr double kEveryDistance = 0.2, kEveryTurn = M_PI / 18.0;  // m, rad, between kept scans

}  // namespace

void PastScans::add(const Scan& scan, const Pose2& T_map_robot) {
  const std::size_t step = steps_++;
  if (!kept_.empty()) {
    const Pose2& last = kept_.back().T_map_robot;
    if ((T_map_robot.position() - last.position()).norm() < kEveryDistance &&
        std::abs(wrapAngle(T_map_robot.theta - last.theta)) < kEveryTurn) {
      return;
    }
  }
  kept_.push_back({step, scan, T_map_robot, T_map_robot});
}

void PastScans::correct(const std::vector<Pose2>& T_map_robot) {
  assert(T_map_robot.size() >= steps_);
  for (Kept& kept : kept_) {
    const Pose2 T_robot_sensor = kept.T_map_robot.inverse() * kept.scan.T_map_sensor;
    kept.T_was_robot = kept.T_map_robot;
    kept.T_map_robot = T_map_robot[kept.step];
    kept.scan.T_map_sensor = kept.T_map_robot * T_robot_sensor;
  }
}

Pose2 PastScans::correctionAt(const Eigen::Vector2d& p_was) const {
  double least = std::numeric_limits<double>::infinity();
  Pose2 T_map_was;
  for (const Kept& kept : kept_) {
    const double distance = (kept.T_was_robot.position() - p_was).norm();
    if (distance > least) continue;
    least = distance;
    T_map_was = kept.T_map_robot * kept.T_was_robot.inverse();
  }
  return T_map_was;
}

Pose2 PastScans::correctionHere() const {
  return kept_.empty() ? Pose2{} : kept_.back().T_map_robot * kept_.back().T_was_robot.inverse();
}

}  // namespace cca
