// SPDX-License-Identifier: BSD-3-Clause
#include "slam/motion_prior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cca {
namespace {

const Eigen::Matrix3d kSure = 1e-8 * Eigen::Matrix3d::Identity();

TEST(MotionPrior, LearnsThatTheWheelsTurnShort) {
  MotionPrior prior;
  const Pose2 wheels{0.5, 0.0, 0.1}, truth{0.5, 0.0, 0.1 - 0.03};
  for (int k = 0; k < 50; ++k) {
    const Pose2 step = k % 2 == 0 ? wheels : Pose2{0.5, 0.0, 0.0};
    const double error = k % 2 == 0 ? -0.03 : -0.025;
    const MotionBelief belief = prior.predict(step);
    prior.learn(step, belief, {0.5, 0.0, step.theta + error}, kSure);
  }
  EXPECT_NEAR(prior.predict(wheels).T_before_after.theta, truth.theta, 0.003);
}

TEST(MotionPrior, TellsTurnsFromNoiseOnTheWayStraightOn) {
  MotionPrior prior;
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.025), match(0.0, 0.002);
  for (int k = 0; k < 400; ++k) {
    const Pose2 step{0.5, 0.0, noise(generator)};
    prior.learn(step, prior.predict(step), {0.5, 0.0, match(generator)}, kSure);
  }
  EXPECT_NEAR(prior.predict(Pose2{0.0, 0.0, 0.65}).T_before_after.theta, 0.65, 0.05);
}

TEST(MotionPrior, LearnsThatTheWheelsTellTooLongAWay) {
  MotionPrior prior;
  const double told = 0.51, way = 0.5, one_spins = 0.0;  // m
  for (int k = 0; k < 20; ++k) {
    const double match_errs = k % 2 == 0 ? 0.005 : -0.005;
    prior.learnWay(told, k == 7 ? one_spins : way + match_errs, 0.01 * 0.01);
  }
  EXPECT_NEAR((1.0 + prior.longer()) * told, way, 0.002);
  EXPECT_NEAR(prior.predict(Pose2{told, 0.0, 0.0}).T_before_after.x, way, 0.002);
}

TEST(MotionPrior, UnlearnsAFirstWayThatErred) {
  MotionPrior prior;
  const double told_late = 0.476, driven = 0.552;  // m, of a robot that speeds up
  prior.learnWay(told_late, driven, 0.002 * 0.002);
  for (int k = 0; k < 20; ++k) prior.learnWay(0.56, 0.56, 0.003 * 0.003);
  EXPECT_NEAR(prior.longer(), 0.0, 0.01);
}

TEST(MotionPrior, LearnsNothingOfAWayThatIsHardlyKnown) {
  MotionPrior prior;
  for (int k = 0; k < 20; ++k) prior.learnWay(0.5, 0.45, 1.0);
  EXPECT_LT(std::abs(prior.longer()), 0.005);
}

TEST(MotionPrior, TrustsWheelsThatHaveProvedGood) {
  MotionPrior prior;
  const Pose2 step{0.5, 0.0, 0.1};
  const double before = prior.predict(step).covariance.trace();
  for (int k = 0; k < 100; ++k) {
    prior.learn(step, prior.predict(step), step, kSure);
    prior.learnWay(0.5, 0.5, kSure(0, 0));
  }
  EXPECT_LT(prior.predict(step).covariance.trace(), 0.1 * before);
}

TEST(MotionPrior, LearnsNothingWhereMatchesKnowNothing) {
  MotionPrior prior;
  const Pose2 step{0.5, 0.0, 0.0};
  const double before = prior.predict(step).covariance(0, 0);
  for (int k = 0; k < 100; ++k) {
    const MotionBelief belief = prior.predict(step);
    prior.learn(step, belief, belief.T_before_after, belief.covariance);
  }
  EXPECT_GT(prior.predict(step).covariance(0, 0), 0.3 * before);
}

TEST(MotionPrior, WithoutWheelsTheRobotGoesOnAsItWent) {
  MotionPrior prior;
  const Pose2 step{0.3, 0.0, 0.05};
  prior.learn(std::nullopt, prior.predict(std::nullopt), step, kSure);
  const MotionBelief belief = prior.predict(std::nullopt);
  EXPECT_EQ(belief.T_before_after.x, step.x);
  EXPECT_GT(belief.covariance(0, 0), 0.01);
}

}  // namespace
}  // namespace cca
