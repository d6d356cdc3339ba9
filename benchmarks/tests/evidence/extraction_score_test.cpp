// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/extraction_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evidence/comparison.hpp"

namespace cca::evidence {
namespace {

LineSegment segment(double x1, double y1, double x2, double y2) {
  LineSegment s;
  s.start = {x1, y1};
  s.end = {x2, y2};
  return s;
}

/// A square room of 4 m around the sensor, without noise.
LabelledScan squareRoom() {
  const std::vector<Segment2> walls{
      {{2, -2}, {2, 2}}, {{2, 2}, {-2, 2}}, {{-2, 2}, {-2, -2}}, {{-2, -2}, {2, -2}}};
  LaserParameters laser;
  laser.range_noise = 0.0;
  Random random(1);
  return sweepOverEdges(walls, Pose2{}, laser, random);
}

const std::vector<LineSegment> kWalls{segment(2, -2, 2, 2), segment(2, 2, -2, 2),
                                      segment(-2, 2, -2, -2), segment(-2, -2, 2, -2)};

TEST(ExtractionScore, TruthItselfIsPerfect) {
  const ExtractionScore s = scoreExtraction(squareRoom(), kWalls);
  EXPECT_DOUBLE_EQ(s.f1.value(), 1.0);
  EXPECT_DOUBLE_EQ(s.explained, 1.0);
  EXPECT_DOUBLE_EQ(s.blocked, 0.0);
  EXPECT_NEAR(s.lateral.value(), 0.0, 1e-12);
  EXPECT_NEAR(s.angular.value(), 0.0, 1e-7);
  EXPECT_NEAR(s.range_rmse.value(), 0.0, 1e-9);
  EXPECT_NEAR(s.covered.value(), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(s.explained_per_segment, 361.0 / 4.0);
}

TEST(ExtractionScore, NoSegmentFindsNothingAndClaimsNothing) {
  const ExtractionScore s = scoreExtraction(squareRoom(), {});
  EXPECT_DOUBLE_EQ(s.f1.value(), 0.0);
  EXPECT_DOUBLE_EQ(s.recall.value(), 0.0);
  EXPECT_FALSE(s.precision.has_value());
  EXPECT_FALSE(s.lateral.has_value());
  EXPECT_DOUBLE_EQ(s.explained, 0.0);
}

TEST(ExtractionScore, AMissedWallCostsRecallAndAnInventedOnePrecision) {
  std::vector<LineSegment> three(kWalls.begin(), kWalls.end() - 1);
  EXPECT_DOUBLE_EQ(scoreExtraction(squareRoom(), three).recall.value(), 0.75);
  EXPECT_DOUBLE_EQ(scoreExtraction(squareRoom(), three).precision.value(), 1.0);
  std::vector<LineSegment> five = kWalls;
  five.push_back(segment(1, -0.5, 1, 0.5));
  const ExtractionScore s = scoreExtraction(squareRoom(), five);
  EXPECT_DOUBLE_EQ(s.precision.value(), 0.8);
  EXPECT_GT(s.blocked, 0.1);
}

TEST(ExtractionScore, AWallInTwoEqualHalvesCountsOnceAtMost) {
  std::vector<LineSegment> halves(kWalls.begin() + 1, kWalls.end());
  halves.push_back(segment(2, -2, 2, -0.01));
  halves.push_back(segment(2, 0.01, 2, 2));
  const ExtractionScore s = scoreExtraction(squareRoom(), halves);
  EXPECT_DOUBLE_EQ(s.recall.value(), 0.75);
  EXPECT_DOUBLE_EQ(s.precision.value(), 0.6);
  EXPECT_NEAR(s.covered.value(), 1.0, 0.01);
}

TEST(ExtractionScore, ErrorsAreThoseOfTheMatchedSegments) {
  std::vector<LineSegment> shifted{segment(2.05, -2, 2.05, 2)};
  EXPECT_NEAR(scoreExtraction(squareRoom(), shifted).lateral.value(), 0.05, 1e-12);
  const double tilt = 2.0 * M_PI / 180.0;
  std::vector<LineSegment> tilted{segment(2 - 2 * std::tan(tilt), -2, 2 + 2 * std::tan(tilt), 2)};
  EXPECT_NEAR(scoreExtraction(squareRoom(), tilted).angular.value(), tilt, 1e-12);
}

TEST(ExtractionScore, SegmentsTooFarOrTooOblique_DoNotMatch) {
  EXPECT_DOUBLE_EQ(scoreExtraction(squareRoom(), {segment(2.11, -2, 2.11, 2)}).recall.value(), 0.0);
  const double tilt = 6.0 * M_PI / 180.0;
  const auto oblique = segment(2 - 2 * std::tan(tilt), -2, 2 + 2 * std::tan(tilt), 2);
  EXPECT_DOUBLE_EQ(scoreExtraction(squareRoom(), {oblique}).recall.value(), 0.0);
}

TEST(LateralDifference, ComparesOnlyTheEdgesThatBothHaveFound) {
  const LabelledScan room = squareRoom();
  const auto trial = [&](const std::vector<LineSegment>& segments) {
    return std::vector<Trial>{{scoreExtraction(room, segments), 0.0}};
  };
  const auto ours = trial({segment(2.01, -2, 2.01, 2), segment(2, 2.09, -2, 2.09)});
  const auto theirs = trial({segment(2.03, -2, 2.03, 2), segment(-2, -2, 2, -2)});
  EXPECT_NEAR(lateralDifference(theirs, ours)->value, 0.02, 1e-9);
  EXPECT_FALSE(lateralDifference(trial({segment(-2, -2, 2, -2)}), ours).has_value());
  EXPECT_DOUBLE_EQ(f1Difference(theirs, ours)->value, 0.0);
}

TEST(PredictedRanges, TakeTheNearerOfTwoSegmentsAndPassBetween) {
  Scan scan;
  scan.ranges.assign(3, 1.0);
  scan.angle_min = 0.0;
  scan.angle_increment = M_PI / 4;
  const auto ranges = predictedRanges(scan, {segment(3, -1, 3, 1), segment(2, -1, 2, 1)});
  EXPECT_DOUBLE_EQ(ranges[0], 2.0);
  EXPECT_TRUE(std::isinf(ranges[1]));
  EXPECT_TRUE(std::isinf(ranges[2]));
}

}  // namespace
}  // namespace cca::evidence
