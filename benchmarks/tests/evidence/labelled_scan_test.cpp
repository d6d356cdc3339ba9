// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/labelled_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca::evidence {
namespace {

TEST(SweepOverEdges, MeasuresTheExactDistanceInTheSensorsFrame) {
  LaserParameters laser;
  laser.range_noise = 0.0;
  laser.beams = 5;
  Random random(1);
  const LabelledScan s =
      sweepOverEdges({{{1.0, 5.0}, {9.0, 5.0}}}, Pose2{4.0, 3.0, M_PI / 2}, laser, random);
  EXPECT_NEAR(s.scan.ranges[2], 2.0, 1e-12);  // straight ahead
  EXPECT_TRUE(std::isinf(s.scan.ranges[0]));
}

TEST(SweepOverEdges, LabelsEndWhereTheRaysEnd) {
  LaserParameters laser;
  laser.range_noise = 0.0;
  laser.range = 5.0;
  Random random(1);
  // A wall 3 m ahead that is seen for 4 m to each side, by Pythagoras, whatever its length.
  const LabelledScan s = sweepOverEdges({{{3.0, -50.0}, {3.0, 50.0}}}, Pose2{}, laser, random);
  ASSERT_EQ(s.edges.size(), 1u);
  EXPECT_NEAR(s.edges[0].length(), 8.0, 0.3);  // a beam spacing at 5 m, 37 degrees incidence, twice
  EXPECT_LE(s.edges[0].length(), 8.0);
}

TEST(SweepOverEdges, AHiddenWallHasNoLabel) {
  LaserParameters laser;
  Random random(1);
  const LabelledScan s = sweepOverEdges({{{2.0, -3.0}, {2.0, 3.0}}, {{3.0, -1.0}, {3.0, 1.0}}},
                                        Pose2{}, laser, random);
  ASSERT_EQ(s.edges.size(), 1u);
  EXPECT_NEAR(s.edges[0].start.x(), 2.0, 1e-12);
}

TEST(SweepOverEdges, AWallBehindAPillarIsOneEdgeOrTwoAsAsked) {
  const std::vector<Segment2> walls{{{3.0, -2.0}, {3.0, 2.0}}, {{1.5, -0.2}, {1.5, 0.2}}};
  LaserParameters laser;
  Random random(1);
  EXPECT_EQ(sweepOverEdges(walls, Pose2{}, laser, random, HiddenWalls::kWhole).edges.size(), 2u);
  EXPECT_EQ(sweepOverEdges(walls, Pose2{}, laser, random, HiddenWalls::kPieces).edges.size(), 3u);
}

TEST(SweepOverEdges, TheSeamBehindTheSensorCutsNoWall) {
  LaserParameters laser;
  Random random(1);
  const LabelledScan s =
      sweepOverEdges({{{-2.0, -1.0}, {-2.0, 1.0}}}, Pose2{}, laser, random, HiddenWalls::kPieces);
  ASSERT_EQ(s.edges.size(), 1u);
  EXPECT_NEAR(s.edges[0].length(), 2.0, 0.1);
}

TEST(SamplePolygons, SurroundTheSensorAndRepeatBySeed) {
  Sampling sampling;
  sampling.scans = 20;
  const auto first = samplePolygons(sampling), second = samplePolygons(sampling);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].scan.ranges, second[i].scan.ranges);
    for (const double range : first[i].scan.ranges) EXPECT_TRUE(isReturn(range));
  }
  sampling.seed = 2;
  EXPECT_NE(samplePolygons(sampling)[0].scan.ranges, first[0].scan.ranges);
}

TEST(SamplePolygons, NoiseDoesNotMoveThePlaces) {
  Sampling sampling;
  sampling.scans = 5;
  sampling.laser.range_noise = 0.0;
  const auto exact = samplePolygons(sampling);
  sampling.laser.range_noise = 0.02;
  const auto noisy = samplePolygons(sampling);
  ASSERT_EQ(exact.size(), 5U);
  ASSERT_EQ(noisy.size(), 5U);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ASSERT_EQ(exact[i].scan.size(), noisy[i].scan.size());
    for (std::size_t k = 0; k < exact[i].scan.size(); ++k) {
      EXPECT_NEAR(exact[i].scan.ranges[k], noisy[i].scan.ranges[k], 0.12);  // six sigma
    }
  }
}

}  // namespace
}  // namespace cca::evidence
