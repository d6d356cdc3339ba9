// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/pose_message.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace cca {
namespace {

geometry_msgs::Transform transformOf(const Eigen::Quaterniond& q) {
  geometry_msgs::Transform t;
  t.translation.x = 1.0;
  t.translation.y = 2.0;
  t.translation.z = 0.3;
  t.rotation.x = q.x(), t.rotation.y = q.y(), t.rotation.z = q.z(), t.rotation.w = q.w();
  return t;
}

Eigen::Quaterniond rotation(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
         AngleAxisd(roll, Vector3d::UnitX());
}

TEST(PoseMessage, EveryHeadingComesBack) {
  for (double theta = -M_PI + 1e-9; theta <= M_PI; theta += 0.1) {
    const Pose2 pose{3.0, -4.0, theta};
    const PlanarPose back = planarPose(transformMessage(pose));
    EXPECT_NEAR(back.pose.x, pose.x, 1e-12);
    EXPECT_NEAR(back.pose.y, pose.y, 1e-12);
    EXPECT_NEAR(wrapAngle(back.pose.theta - theta), 0.0, 1e-12);
    EXPECT_FALSE(back.upside_down);
    EXPECT_EQ(poseMessage(pose).orientation.z, transformMessage(pose).rotation.z);
  }
}

/// The oracle: each beam's end point in three dimensions, seen from above.
TEST(PlaceScan, PutsEachBeamWhereTheSpatialTransformPutsIt) {
  for (const double roll : {0.0, M_PI}) {
    for (double yaw = -3.0; yaw < 3.1; yaw += 0.5) {
      const Eigen::Quaterniond q = rotation(roll, 0.0, yaw);
      Scan scan;
      scan.angle_min = -1.0;
      scan.angle_increment = 0.4;
      scan.ranges = {1.0, 2.0, 3.0, 4.0};
      const Scan before = scan;
      placeScan(scan, planarPose(transformOf(q)));
      for (std::size_t i = 0; i < scan.size(); ++i) {
        const double b = before.bearing(i), r = before.ranges[i];
        const Eigen::Vector3d truth =
            q * Eigen::Vector3d(r * std::cos(b), r * std::sin(b), 0) + Eigen::Vector3d(1, 2, 0.3);
        const double c = scan.bearing(i);
        const Eigen::Vector2d p =
            scan.T_map_sensor * Eigen::Vector2d(r * std::cos(c), r * std::sin(c));
        EXPECT_NEAR((p - truth.head<2>()).norm(), 0.0, 1e-9) << "roll " << roll << " yaw " << yaw;
      }
    }
  }
}

TEST(PlanarPose, ALittleTiltOfABumpyFloorIsTakenAndALaserOnItsSideIsNot) {
  EXPECT_NEAR(planarPose(transformOf(rotation(0.05, 0.05, 1.0))).pose.theta, 1.0, 0.01);
  EXPECT_THROW(planarPose(transformOf(rotation(M_PI / 2, 0, 0))), std::runtime_error);
  EXPECT_THROW(planarPose(transformOf(rotation(0, 0.35, 0))), std::runtime_error);
}

TEST(PlanarPose, WhatIsNoRigidMotionIsRefused) {
  EXPECT_THROW(planarPose(geometry_msgs::Transform()), std::runtime_error);  // w = 0: never set
  auto broken = transformMessage({});
  broken.translation.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(planarPose(broken), std::runtime_error);
  broken = transformMessage({});
  broken.rotation.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(planarPose(broken), std::runtime_error);
}

}  // namespace
}  // namespace cca
