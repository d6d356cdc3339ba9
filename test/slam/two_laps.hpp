// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "slam/key_frames.hpp"
#include "walled_world.hpp"

namespace cca::test {

/// Key frames of two laps around the ring of corridors, tied by wheels alone; they stand where they
/// were taken.
struct TwoLaps {
  /// @param people  share of the returns that somebody stands before, in each scan elsewhere.
  explicit TwoLaps(double people = 0.0) {
    WalledWorld world = ringWithNiches();
    const std::vector<Eigen::Vector2d> corners{{1, 1}, {19, 1}, {19, 15}, {1, 15}};
    for (int side = 0; side < 8; ++side) {
      const Eigen::Vector2d from = corners[static_cast<std::size_t>(side % 4)];
      const Eigen::Vector2d leg = corners[static_cast<std::size_t>((side + 1) % 4)] - from;
      for (double s = 0.0; s < leg.norm(); s += 0.5) {
        const Eigen::Vector2d at = from + s * leg.normalized();
        add(world, {at.x(), at.y(), std::atan2(leg.y(), leg.x())}, people);
      }
    }
    lap = frames.size() / 2;
  }

  /// Moves the frames of the second lap as one body.
  void moveSecond(const Eigen::Vector2d& by) {
    for (int k = lap; k < frames.size(); ++k) {
      Pose2 pose = truth[static_cast<std::size_t>(k)];
      pose.x += by.x();
      pose.y += by.y();
      frames.graph.place(k, pose);
    }
  }

  /// m, by which frames of the second lap lie off, as those of the first see them, at most.
  double worstTear() const {
    double worst = 0.0;
    for (int k = 0; k < lap; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const auto again = static_cast<std::size_t>(k + lap);
      const Pose2 seen = frames.graph.pose(k).inverse() * frames.graph.pose(k + lap);
      const Pose2 right = truth[at].inverse() * truth[again];
      worst = std::max(worst, difference(seen, right).head<2>().norm());
    }
    return worst;
  }

  KeyFrames frames;
  std::vector<Pose2> truth;
  int lap = 0;  ///< frames of each

 private:
  void add(WalledWorld& world, const Pose2& pose, double people) {
    Scan scan = world.scan(pose, 361, 2.0 * M_PI, 0.01, 12.0);
    const auto wide = static_cast<std::size_t>(people * static_cast<double>(scan.size()));
    const std::size_t first = (frames.surfaces.size() * 97) % scan.size();
    for (std::size_t k = 0; k < wide; ++k) {
      double& range = scan.ranges[(first + k) % scan.size()];
      range = std::min(range, 0.6);
    }
    frames.surfaces.push_back(scanSurface(scan));
    truth.push_back(pose);
    const int frame = frames.graph.add(pose);
    if (frame == 0) return;
    // 1.5 cm and .2 degrees a step.
    const Eigen::Vector3d information(4444.0, 4444.0, 82000.0);
    frames.graph.connect({frame - 1, frame, frames.graph.pose(frame - 1).inverse() * pose,
                          information.asDiagonal(), EdgeKind::kWheels});
  }
};

}  // namespace cca::test
