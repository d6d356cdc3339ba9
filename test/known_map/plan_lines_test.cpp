// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace cca
