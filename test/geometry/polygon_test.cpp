// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cca {
namespace {

TEST(Polygon, HoldsWhatLiesInsideWhicheverWayItTurns) {
  Polygon corner{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_TRUE(isInside(corner, {0.5, 2.5}));
    EXPECT_TRUE(isInside(corner, {3.5, 0.5}));
    EXPECT_FALSE(isInside(corner, {2.0, 2.0})) << "in its nook";
    EXPECT_FALSE(isInside(corner, {-0.1, 0.5}));
    EXPECT_FALSE(isInside(corner, {4.1, 0.5}));
    std::reverse(corner.begin(), corner.end());
  }
  EXPECT_EQ(boundsOf(corner).min(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(boundsOf(corner).max(), Eigen::Vector2d(4, 3));
}

TEST(Polygon, OfNoCornersHoldsNothing) {
  EXPECT_FALSE(isInside({}, {0, 0}));
  EXPECT_TRUE(boundsOf({}).isEmpty());
}

}  // namespace
}  // namespace cca
