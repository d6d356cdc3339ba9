// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_lines.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

namespace cca {
namespace {

const PlanLines kCorner({{{0.0, 0.0}, {5.0, 0.0}}, {{5.0, 0.0}, {5.0, 3.0}}});

TEST(PlanLines, CutALineIntoEqualPiecesThatKnowWhereTheLineEnds) {
  const PlanLines plan({{{0.0, 0.0}, {5.0, 0.0}}});
  ASSERT_EQ(plan.pieces().size(), 3U);
  for (const auto& piece : plan.pieces()) EXPECT_DOUBLE_EQ(piece.length, 5.0 / 3.0);
  EXPECT_TRUE(plan[0].begins);
  EXPECT_FALSE(plan[0].ends);
  EXPECT_FALSE(plan[1].begins);
  EXPECT_TRUE(plan[2].ends);
}

TEST(PlanLines, LeaveOutALineWithoutLength) {
  EXPECT_TRUE(PlanLines({{{1.0, 1.0}, {1.0, 1.0}}}).empty());
}

TEST(PlanLines, TheNearestFacesAlikeOrTheOtherWay) {
  const Eigen::Vector2d p(4.9, 0.2);  // nearer to the wall along y
  EXPECT_DOUBLE_EQ(std::abs(kCorner[kCorner.nearest(p, {0, 0}, 0.5)].direction.y()), 1.0);
  EXPECT_DOUBLE_EQ(std::abs(kCorner[kCorner.nearest(p, {0, 1}, 0.5)].direction.x()), 1.0);
  EXPECT_DOUBLE_EQ(std::abs(kCorner[kCorner.nearest(p, {0, -1}, 0.5)].direction.x()), 1.0);
  EXPECT_LT(kCorner.nearest(p, {0, 1}, 0.15), 0);
}

TEST(PlanLines, ADistanceIsThatOfTheEndBesideALine) {
  EXPECT_DOUBLE_EQ(PlanLines::distance(kCorner[0], {-3.0, 4.0}), 5.0);
}

TEST(PlanLines, ARayIsTakenThroughAWallOnlyWhereItEndsWellBehindIt) {
  EXPECT_GE(kCorner.crossed({2.0, 1.0}, {2.0, -1.0}, 0.2, {}), 0);
  EXPECT_LT(kCorner.crossed({2.0, 1.0}, {2.0, -0.1}, 0.2, {}), 0);
  EXPECT_LT(kCorner.crossed({2.0, 2.0}, {2.0, 0.0}, 0.2, {}), 0);
}

TEST(PlanLines, ARayMayPassByTheEndOfALineButNotByThatOfAPiece) {
  EXPECT_LT(kCorner.crossed({0.1, 1.0}, {0.1, -1.0}, 0.2, {}), 0);
  const double seam = 5.0 / 3.0;
  EXPECT_GE(kCorner.crossed({seam + 0.01, 1.0}, {seam + 0.01, -1.0}, 0.2, {}), 0);
}

TEST(PlanLines, ARayMayPassAPieceThatIsOpen) {
  std::vector<bool> is_open(kCorner.pieces().size(), false);
  const auto slot = kCorner.crossed({2.0, 1.0}, {2.0, -1.0}, 0.2, is_open);
  ASSERT_GE(slot, 0);
  is_open[static_cast<std::size_t>(slot)] = true;
  EXPECT_LT(kCorner.crossed({2.0, 1.0}, {2.0, -1.0}, 0.2, is_open), 0);
}

TEST(PlanLines, WhateverARayCrossesIsFoundAlsoOnTheBordersOfCells) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> at(-30, 30);
  const auto corner = [&] { return Eigen::Vector2d(0.2 * at(random), 0.2 * at(random)); };
  std::vector<PlanLine> lines;
  for (int k = 0; k < 12; ++k) lines.emplace_back(corner(), corner());
  const PlanLines plan(lines);
  int crossed = 0, others = 0;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector2d from = corner(), to = corner();
    bool is_clear = true, is_through = false;  // of every line
    for (const auto& [start, end] : lines) {
      Eigen::Matrix2d axes;
      axes << to - from, start - end;
      const double area = std::abs(axes.determinant()), length = (end - start).norm();
      if (area < 1e-9 || length < 1e-9) continue;
      const Eigen::Vector2d share = axes.inverse() * (start - from);
      const double along = share.y() * length, across = area / length;  // m
      const bool is_crossed = share.x() * across > 0.11 && (1.0 - share.x()) * across > 0.21 &&
                              along > 0.16 && along < length - 0.16;
      is_through = is_through || is_crossed;
      is_clear = is_clear && (share.x() < 0.0 || share.x() > 1.0 || along < 0.0 || along > length);
    }
    const bool is_found = plan.crossed(from, to, 0.2, {}) >= 0;
    if (is_through || is_clear) {
      EXPECT_EQ(is_found, is_through) << k;
    }
    crossed += is_through;
    others += is_clear;
  }
  EXPECT_GT(crossed, 100);
  EXPECT_GT(others, 100);
}

TEST(PlanLines, AStrayLineFarAwayIsFoundAndDoesNotFillTheGridBetween) {
  const Eigen::Vector2d far(1e5, -1e5);  // m: cells between them would take a terabyte
  const PlanLines plan({{{0.0, 0.0}, {5.0, 0.0}}, {far, far + Eigen::Vector2d(1.0, 0.0)}});
  EXPECT_GE(plan.nearest({1.0, 0.1}, {0, 1}, 0.2), 0);
  EXPECT_GE(plan.nearest(far + Eigen::Vector2d(0.5, 0.1), {0, 1}, 0.2), 0);
  EXPECT_LT(plan.nearest(0.5 * far, {0, 0}, 0.2), 0);
}

}  // namespace
}  // namespace cca
