// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/labelled_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

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

TEST(LoadSegments, PassesOverCommentsAndHeader) {
  const std::string path = testing::TempDir() + "segments.csv";
  std::ofstream(path) << "# a comment\nx1,y1,x2,y2,id\n\n0,0,1,0,7\n# another\n1;0 1 2\r\n";
  const auto segments = loadSegments(path);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1].end, Eigen::Vector2d(1.0, 2.0));
  std::ofstream(path) << "0,0,1e6,0\n";
  EXPECT_THROW(loadSegments(path), std::runtime_error);
}

TEST(LoadSegments, GoesByTheNamesOfTheHeader) {
  const std::string path = testing::TempDir() + "extracted.csv";
  std::ofstream(path) << "scan_id,y2,x1,y1,x2\n17,4,1,2,3\n";
  const auto segments = loadSegments(path);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].start, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(segments[0].end, Eigen::Vector2d(3.0, 4.0));
  std::ofstream(path) << "x1,y1,x2,y2\n";
  EXPECT_TRUE(loadSegments(path).empty());
  for (const char* text :
       {"", "# nothing\n", "a,b,c,d\n0,0,1,1\n", "0,0,1m,1\n", "0,0,1,1\nx1,y1,x2,y2\n"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(loadSegments(path), std::runtime_error) << text;
  }
}

TEST(LoadSegments, NamesFileAndLineOfWhatItCannotRead) {
  const std::string path = testing::TempDir() + "edges.csv";
  std::ofstream(path) << "x1,y1,x2,y2\n0,0,1,0\n0,zero,1,1\n";
  try {
    loadSegments(path);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("edges.csv:3"), std::string::npos) << error.what();
  }
  EXPECT_THROW(loadSegments(path + ".absent"), std::runtime_error);
}

}  // namespace
}  // namespace cca::evidence
