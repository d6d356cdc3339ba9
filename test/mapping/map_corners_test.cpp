// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_corners.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

MapLine line(double x1, double y1, double x2, double y2) {
  MapLine line;
  line.segment.start = {x1, y1};
  line.segment.end = {x2, y2};
  return line;
}

TEST(CutOvershoots, AnEndIsCutAtTheWallItMeets) {
  std::vector<MapLine> lines{line(0, 0, 4.12, 0), line(4, -2, 4, 2)};
  cutOvershoots(lines, 0.2);
  EXPECT_NEAR(lines[0].segment.end.x(), 4.0, 1e-12);
  EXPECT_EQ(lines[0].segment.start, Eigen::Vector2d(0, 0));
  EXPECT_EQ(lines[1].segment.start, Eigen::Vector2d(4, -2));
  EXPECT_EQ(lines[1].segment.end, Eigen::Vector2d(4, 2));
}

TEST(CutOvershoots, WhatIsLongerThanTheScatterIsAWall) {
  std::vector<MapLine> lines{line(0, 0, 4.12, 0), line(4, -2, 4, 2)};
  cutOvershoots(lines, 0.1);
  EXPECT_EQ(lines[0].segment.end.x(), 4.12);
}

TEST(CutOvershoots, AWallThatEndsBeforeCutsNothing) {
  std::vector<MapLine> lines{line(0, 0, 4.12, 0), line(4, 0.3, 4, 2)};
  cutOvershoots(lines, 0.2);
  EXPECT_EQ(lines[0].segment.end.x(), 4.12);
}

TEST(CutOvershoots, BothEndsOfACornerMeet) {
  std::vector<MapLine> lines{line(0, 0, 4.15, 0), line(4, -0.15, 4, 2)};
  cutOvershoots(lines, 0.2);
  EXPECT_LT((lines[0].segment.end - lines[1].segment.start).norm(), 1e-12);
  EXPECT_EQ(joinCorners(lines, 0.1).size(), 1u);
}

TEST(CutOvershoots, AShortLineKeepsHalfOfItself) {
  std::vector<MapLine> lines{line(3.9, 0, 4.15, 0), line(4, -2, 4, 2)};
  cutOvershoots(lines, 0.2);
  EXPECT_EQ(lines[0].segment.end.x(), 4.15);
}

}  // namespace
}  // namespace cca
