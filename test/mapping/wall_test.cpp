// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

/// A wall along y = `y`, hit ten times in each bin of [from, to).
Wall wallAlongX(double y, double from, double to) {
  Wall wall;
  wall.origin = {0.0, y};
  for (double t = from + 0.025; t < to; t += SupportProfile::kBinLength) {
    for (int k = 0; k < 10; ++k) wall.profile.hit(t, 0.0);
  }
  wall.fit = wall.profile.fit();
  return wall;
}

double passed(const Wall& wall, double t) {
  const int i = SupportProfile::binOf(t);
  return wall.profile.contains(i) ? wall.profile.bin(i).passed : 0.0;
}

/// Two stretches with a gap from 1 m to 2 m, through which five rays went at 1.525 m.
Wall wallWithAGapSeenThrough(double y) {
  Wall wall = wallAlongX(y, 0.0, 1.0);
  for (double t = 2.025; t < 3.0; t += SupportProfile::kBinLength) wall.profile.hit(t, 0.0);
  wall.profile.pass(1.525, 5.0);
  return wall;
}

TEST(Absorb, KeepsTheDoorwayOfTheOtherWallOpen) {
  Wall wall = wallAlongX(0.0, 0.0, 1.0);
  absorb(wall, wallWithAGapSeenThrough(0.05));
  EXPECT_DOUBLE_EQ(passed(wall, 1.525), 5.0);
}

TEST(Absorb, DoesNotHoldRaysThroughTheOtherLineAgainstHitsOfItsOwn) {
  Wall wall = wallAlongX(0.0, 1.0, 2.0);
  absorb(wall, wallWithAGapSeenThrough(0.05));
  EXPECT_DOUBLE_EQ(passed(wall, 1.525), 0.0);
  EXPECT_DOUBLE_EQ(wall.profile.bin(SupportProfile::binOf(1.525)).hits(), 10.0);
}

TEST(Absorb, ForgetsADoorwayOfALineThatWasFarOff) {
  Wall wall = wallAlongX(0.0, 0.0, 1.0);
  absorb(wall, wallWithAGapSeenThrough(0.3));
  EXPECT_DOUBLE_EQ(passed(wall, 1.525), 0.0);
}

TEST(Absorb, KeepsEveryHitAndItsPlace) {
  Wall wall = wallAlongX(0.0, 0.0, 1.0);
  const Wall other = wallAlongX(0.02, 0.5, 3.0);
  absorb(wall, other);
  double hits = 0.0, t = 0.0, d = 0.0;
  for (int i = wall.profile.first(); i < wall.profile.last(); ++i) {
    hits += wall.profile.bin(i).hits();
    t += wall.profile.bin(i).returns.x;
    d += wall.profile.bin(i).returns.y;
  }
  EXPECT_NEAR(hits, 200.0 + 500.0, 1e-9);
  EXPECT_NEAR(t, 200.0 * 0.5 + 500.0 * 1.75, 1e-6);
  EXPECT_NEAR(d, 500.0 * 0.02, 1e-9);
}

TEST(Recut, EachPieceLiesOnItsOwnReturns) {
  Wall wall = wallAlongX(0.0, 0.0, 2.0);
  for (double t = 3.025; t < 5.0; t += SupportProfile::kBinLength) {
    for (int k = 0; k < 10; ++k) wall.profile.hit(t, 0.03);
  }
  refit(wall);
  std::uint64_t next_id = 1;
  recut(wall, MapNoise{}, 16.0, next_id);
  ASSERT_EQ(wall.pieces.size(), 2u);
  for (const MapLine& piece : wall.pieces) {
    const double y = piece.segment.start.x() < 2.5 ? 0.0 : 0.03;
    EXPECT_NEAR(piece.segment.start.y(), y, 0.002);
    EXPECT_NEAR(piece.segment.end.y(), y, 0.002);
  }
}

/// Number of pieces of a wall from 0 to `length` m of which `hits` fell on each bin.
std::size_t piecesOf(double length, int hits, double line_price, const MapNoise& noise = {}) {
  Wall wall;
  for (double t = 0.025; t < length; t += SupportProfile::kBinLength) {
    for (int k = 0; k < hits; ++k) wall.profile.hit(t, 0.0);
  }
  refit(wall);
  std::uint64_t next_id = 1;
  recut(wall, noise, line_price, next_id);
  return wall.pieces.size();
}

TEST(Recut, AStubIsALineWhereTheNoiseLetsItsDirectionBeKnown) {
  MapNoise fine, coarse;
  for (int i = 0; i < 500; ++i) {
    fine.learnOffset(0.0, 1e-4);
    coarse.learnOffset(i % 2 == 0 ? 0.1 : -0.1, 1e-4);
  }
  ASSERT_LT(fine.lateralSigma(), 0.01);
  ASSERT_GT(coarse.lateralSigma(), 0.05);
  EXPECT_EQ(piecesOf(0.2, 50, 16.0, fine), 1u);
  EXPECT_EQ(piecesOf(0.2, 50, 16.0, coarse), 0u);
  EXPECT_EQ(piecesOf(1.0, 50, 16.0, coarse), 1u);
}

TEST(Recut, ALineTakesAsManyReturnsAsItsPrice) {
  EXPECT_EQ(piecesOf(1.0, 1, 16.0), 1u);  // twenty bins
  EXPECT_EQ(piecesOf(1.0, 1, 24.0), 0u);
}

TEST(YieldBins, SparseHitsBetweenThoseOfTheGreaterWallGoToIt) {
  Wall greater, lesser;
  for (int i = 0; i < 40; i += 2) greater.profile.hit((i + 0.5) * SupportProfile::kBinLength, 0.0);
  for (int i = 31; i < 60; i += 2) lesser.profile.hit((i + 0.5) * SupportProfile::kBinLength, 0.0);
  greater.fit = greater.profile.fit();
  lesser.fit = lesser.profile.fit();
  const auto lies_within = [&](int bin, double off) {
    return greater.profile.spans(bin) && std::abs(off) < 0.03;
  };
  EXPECT_TRUE(yieldBins(lesser, greater, lies_within));
  lesser.profile.prune();
  EXPECT_EQ(lesser.profile.first(), 39);  // the greater ends at 38
}

}  // namespace
}  // namespace cca
