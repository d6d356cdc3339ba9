// SPDX-License-Identifier: BSD-3-Clause
// What each of the five memberships of the map is for: pairs that it alone keeps apart.
#include "mapping/map_similarity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

constexpr double kCut = 0.5;

/// A wall that was hit 20 times in each bin, `length` [m] long, its first point at `start`, seen
/// from its left.
Wall wallFrom(const Eigen::Vector2d& start, double heading, double length) {
  Wall wall;
  wall.origin = start;
  wall.direction = {std::cos(heading), std::sin(heading)};
  for (double t = 0.5 * SupportProfile::kBinLength; t < length; t += SupportProfile::kBinLength) {
    for (int k = 0; k < 20; ++k) wall.profile.hit(t, 0.0);
  }
  refit(wall);
  return wall;
}

/// A line of 40 returns of one scan, whose place and angle are known to 1 cm and 0.01 rad.
NewLine lineFrom(const Eigen::Vector2d& start, double heading, double length) {
  NewLine line;
  LineSegment& s = line.segment;
  s.start = start;
  s.end = start + length * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  for (int i = 0; i < 40; ++i) s.moments.add(s.start + (s.end - s.start) * i / 39.0);
  s.covariance << 1e-4, 0.0, 0.0, 1e-4;
  return line;
}

double least(const Memberships& mu) { return AlphaCut(kCut).similarity(mu); }
double leastWithout(const Memberships& mu, Part part) {
  return AlphaCut(kCut, Ablation(part)).similarity(mu);
}
void expectDecided(const Memberships& mu, Part part) {
  EXPECT_LT(least(mu), kCut);
  EXPECT_GE(leastWithout(mu, part), kCut);
}

TEST(MapMemberships, OfAWallSeenAgainAreAllNearOne) {
  const Wall wall = wallFrom({0, 0}, 0.0, 3.0);
  EXPECT_GT(least(mapMemberships(lineFrom({1.0, 0.005}, 0.002, 1.0), wall, {})), 0.9);
  EXPECT_GT(least(mapMemberships(wall, wallFrom({3.1, 0.002}, 0.001, 2.0), {})), 0.9);
}

TEST(MapMemberships, AnAngleAloneKeepsApartWhatLeavesTheEndOfAWall) {
  const Wall wall = wallFrom({0, 0}, 0.0, 3.0);
  expectDecided(mapMemberships(wall, wallFrom({3.0, -0.04}, 0.15, 1.0), {}), Part::kOrientation);
  expectDecided(mapMemberships(lineFrom({1.0, -0.03}, 0.1, 0.6), wall, {}), Part::kOrientation);
}

TEST(MapMemberships, AnOffsetAloneKeepsApartAStepInAWall) {
  const Wall wall = wallFrom({0, 0}, 0.0, 3.0);
  expectDecided(mapMemberships(wall, wallFrom({3.1, 0.08}, 0.0, 3.0), {}), Part::kOffset);
  expectDecided(mapMemberships(lineFrom({1.0, 0.08}, 0.0, 1.0), wall, {}), Part::kOffset);
}

TEST(MapMemberships, AGapAloneKeepsApartTwoWallsOfOneLine) {
  const Wall wall = wallFrom({0, 0}, 0.0, 3.0);
  expectDecided(mapMemberships(wall, wallFrom({4.2, 0.0}, 0.0, 3.0), {}), Part::kGap);
  expectDecided(mapMemberships(lineFrom({3.5, 0.0}, 0.0, 1.0), wall, {}), Part::kGap);
}

TEST(MapMemberships, TheFitAloneKeepsApartWhatAShortLinePromisesByItsAngle) {
  // The little that is known of the wall would let it turn towards the line.
  const Wall wall = wallFrom({0, 0}, 0.0, 0.1);
  const NewLine line = lineFrom({0.35, 0.1}, 0.1, 0.5);
  expectDecided(mapMemberships(line, wall, {}), Part::kFit);
}

TEST(MapMemberships, TheOverlapAloneKeepsApartTheTwoFacesOfAThinWall) {
  const Wall face = wallFrom({0, 0}, 0.0, 3.0), back = wallFrom({3.0, -0.125}, M_PI, 3.0);
  expectDecided(mapMemberships(face, back, {}), Part::kOverlap);
  // On one side the two can be but one face, seen at two poses.
  EXPECT_GE(least(mapMemberships(face, wallFrom({0, -0.125}, 0.0, 3.0), {})), kCut);
}

TEST(MapMemberships, NoLineOfTheOtherSideIsTakenForAWallKnownFromOne) {
  Wall wall = wallFrom({0, 0}, 0.0, 3.0);
  const NewLine line = lineFrom({2.0, 0.0}, M_PI, 1.0);
  EXPECT_EQ(least(mapMemberships(line, wall, {})), 0.0);
  wall.two_sided = true;
  EXPECT_GT(least(mapMemberships(line, wall, {})), 0.9);
}

TEST(MapMemberships, AreZeroWhereAWallWouldOutgrowItsBound) {
  const Wall wall = wallFrom({0, 0}, 0.0, 15.0), too_long = wallFrom({15.0, 0}, 0.0, 6.0);
  EXPECT_EQ(least(mapMemberships(wall, too_long, {})), 0.0);
  EXPECT_GT(least(mapMemberships(wall, wallFrom({15.0, 0}, 0.0, 4.0), {})), 0.9);
  EXPECT_GT(least(membershipsOfAnyLength(wall, too_long, {})), 0.9);
}

TEST(WouldOutgrow, AsksForTheLengthOfBothTogether) {
  const Wall wall = wallFrom({0, 0}, 0.0, 15.0);
  EXPECT_TRUE(wouldOutgrow(wall, wallFrom({15.0, 0}, 0.0, 6.0)));
  EXPECT_FALSE(wouldOutgrow(wall, wallFrom({15.0, 0}, 0.0, 4.0)));
  const Wall longest = wallFrom({0, 0}, 0.0, 24.0);
  EXPECT_FALSE(wouldOutgrow(longest, wallFrom({2.0, 0}, 0.0, 15.0)));  // adds nothing
  EXPECT_TRUE(wouldOutgrow(longest, wallFrom({12.0, 0}, 0.0, 15.0)));
}

TEST(MapMemberships, OfTwoWallsDoNotDependOnWhichIsAskedFirst) {
  for (const double turn : {0.0, 0.02, 0.05}) {
    for (const double step : {0.0, 0.05, 0.1}) {
      const Wall a = wallFrom({0, 0}, 0.0, 3.0), b = wallFrom({1.5, step}, turn, 2.5);
      EXPECT_NEAR(least(mapMemberships(a, b, {})), least(mapMemberships(b, a, {})), 0.02);
    }
  }
}

}  // namespace
}  // namespace cca
