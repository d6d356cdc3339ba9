// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/pose2.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

TEST(Pose2, InverseUndoesThePose) {
  const Pose2 T{1.0, -2.0, 2.5};
  const Eigen::Vector2d p(0.3, 0.7);
  EXPECT_NEAR((T.inverse() * (T * p) - p).norm(), 0.0, 1e-12);
  EXPECT_NEAR((T * T.inverse()).position().norm(), 0.0, 1e-12);
}

TEST(Pose2, CompositionEqualsOneAfterTheOther) {
  const Pose2 a{1.0, 2.0, 3.0}, b{-0.5, 0.25, 2.0};
  const Eigen::Vector2d p(0.3, 0.7);
  EXPECT_NEAR(((a * b) * p - a * (b * p)).norm(), 0.0, 1e-12);
}

TEST(Pose2, DifferenceIsAStepInTheCommonFrameAndTurnsTheShortWay) {
  const Pose2 a{1.0, 2.0, 3.0}, b{0.5, 4.0, -3.0};
  const Eigen::Vector3d step = difference(b, a);
  EXPECT_DOUBLE_EQ(step.x(), -0.5);
  EXPECT_DOUBLE_EQ(step.y(), 2.0);
  EXPECT_NEAR(step.z(), 2.0 * M_PI - 6.0, 1e-12);
  EXPECT_EQ(difference(a, a), Eigen::Vector3d::Zero());
}

TEST(Pose2, TheWayBetweenTwoPosesIsEvenAndTurnsTheShortWay) {
  const Pose2 a{1.0, 2.0, 3.0}, b{0.5, 4.0, -3.0};
  const Pose2 between = poseBetween(a, b, 0.75);
  EXPECT_NEAR(between.x, 0.625, 1e-12);
  EXPECT_NEAR(between.y, 3.5, 1e-12);
  EXPECT_NEAR(between.theta, 3.0 + 0.75 * (2.0 * M_PI - 6.0) - 2.0 * M_PI, 1e-12);
  for (double share : {0.0, 1.0}) {
    EXPECT_NEAR(difference(poseBetween(a, b, share), share == 0.0 ? a : b).norm(), 0.0, 1e-12);
  }
}

TEST(WrapAngle, StaysWithinHalfATurnAndKeepsTheDirection) {
  for (double angle = -20.0; angle < 20.0; angle += 0.1) {
    EXPECT_LE(std::abs(wrapAngle(angle)), M_PI);
    EXPECT_NEAR(std::cos(wrapAngle(angle)), std::cos(angle), 1e-12);
    EXPECT_NEAR(std::sin(wrapAngle(angle)), std::sin(angle), 1e-12);
  }
  EXPECT_DOUBLE_EQ(wrapAngle(-M_PI), M_PI);
}

}  // namespace
}  // namespace cca
