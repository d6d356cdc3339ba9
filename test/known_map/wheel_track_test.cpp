// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/wheel_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

const Eigen::Matrix2d kMatched = 1e-4 * Eigen::Matrix2d::Identity();  // m^2

TEST(WheelTrack, ExpectsNothingBeforeAPlaceWasTrusted) {
  WheelTrack track;
  track.add({1.0, 0.0, 0.0});
  EXPECT_FALSE(track.expectation());
}

TEST(WheelTrack, ExpectsTheRobotWhereItsWheelsHaveItSinceItWasTrusted) {
  WheelTrack track;
  track.add({2.0, 0.0, 0.5 * M_PI});
  track.trust({10.0, 20.0, 0.0});
  const auto at_once = track.expectation();
  track.add({1.0, 0.0, 0.3});
  const auto later = track.expectation();
  ASSERT_TRUE(at_once && later);
  const Pose2 expected = later->T_map_wheels * track.T_wheels_sensor();
  EXPECT_NEAR(expected.x, 11.0, 1e-12);
  EXPECT_NEAR(expected.y, 20.0, 1e-12);
  EXPECT_NEAR(expected.theta, 0.3, 1e-12);
  EXPECT_GT(later->reach, at_once->reach);
  EXPECT_GT(later->turn, at_once->turn);
}

TEST(WheelTrack, ExpectsNoFartherThanIsSearched) {
  WheelTrack track;
  track.trust({});
  for (int i = 0; i < 1000; ++i) track.add({1.0, 0.0, 0.1});
  EXPECT_EQ(track.expectation()->reach, Expectation::kWidestReach);
  EXPECT_EQ(track.expectation()->turn, Expectation::kWidestTurn);
}

TEST(WheelTrack, JudgesAWayOfAMetreByTheMatchesAtItsEnds) {
  WheelTrack track;
  EXPECT_FALSE(track.judge({5.0, 5.0, 0.5 * M_PI}, kMatched));  // the way begins here
  track.add({0.6, 0.0, 0.0});
  EXPECT_FALSE(track.judge({5.0, 5.63, 0.5 * M_PI}, kMatched));  // too short
  track.add({0.6, 0.0, 0.0});
  const auto way = track.judge({5.0, 6.26, 0.5 * M_PI}, kMatched);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->by_wheels, 1.2, 1e-12);
  EXPECT_NEAR(way->matched, 1.26, 1e-12);
  EXPECT_NEAR(way->variance, 2e-4, 1e-12);  // of both ends
}

TEST(WheelTrack, JudgesNoWayOnWhichSomebodyCarriedTheRobot) {
  WheelTrack track;
  track.judge({}, kMatched);
  track.add({2.0, 0.0, 0.0});
  track.breakOff();
  EXPECT_FALSE(track.judge({9.0, 0.0, 0.0}, kMatched));
}

}  // namespace
}  // namespace cca
