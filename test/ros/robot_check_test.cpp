// SPDX-License-Identifier: BSD-3-Clause
#include "ros/driving/robot_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cca {
namespace {

tf2_msgs::TFMessage joint(const std::string& parent, const std::string& child) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = parent;
  message.transforms[0].child_frame_id = child;
  return message;
}

bool hasFault(const RobotCheck& check, const std::string& words) {
  const std::vector<Finding> findings = check.findings(Transforms());
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.kind == Finding::Kind::kFault && finding.what.find(words) != std::string::npos;
  });
}

TEST(RobotCheck, OneFrameIsToldOfByOneNodeAndInOneFrame) {
  RobotCheck check({});
  check.take(joint("odom", "base_link"), "/wheels");
  check.take(joint("/odom", "/base_link"), "/wheels");
  check.take(joint("map", "odom"), "/amcl");
  EXPECT_FALSE(hasFault(check, "is told in"));
  RobotCheck two_nodes = check, two_parents = check;
  two_nodes.take(joint("odom", "base_link"), "/robot_pose_ekf");
  EXPECT_TRUE(hasFault(two_nodes,
                       "'base_link' is, is told in 'odom' by /robot_pose_ekf, and in "
                       "'odom' by /wheels"));
  two_parents.take(joint("odom_combined", "base_link"), "/wheels");
  EXPECT_TRUE(hasFault(two_parents, "'odom_combined' by /wheels"));
}

TEST(RobotCheck, ThePoseIsThereWhenAScanComes) {
  RobotCheck late({}), sound({});
  for (int k = 0; k < 5; ++k) {
    late.takePoseAge(2.0);
    sound.takePoseAge(0.05);
  }
  EXPECT_TRUE(hasFault(late, "odom -> base_link is 2.00 s old"));
  EXPECT_FALSE(hasFault(sound, "s old"));
}

}  // namespace
}  // namespace cca
