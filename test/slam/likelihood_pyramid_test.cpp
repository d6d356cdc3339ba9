// SPDX-License-Identifier: BSD-3-Clause
#include "slam/likelihood_pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kCell = 0.1;  // m

/// Returns along two walls that are oblique to the cells; those of the second face nowhere.
std::vector<SurfacePoint> returns() {
  std::vector<SurfacePoint> points;
  for (int k = 0; k < 40; ++k) {
    points.push_back({{0.07 * k - 1.0, 0.03 * k + 0.5}, Eigen::Vector2d(-3.0, 7.0).normalized()});
    points.push_back({{0.5, 0.09 * k - 2.0}, Eigen::Vector2d::Zero()});
  }
  return points;
}

Eigen::Vector2i cellOf(const LikelihoodPyramid& pyramid, const Eigen::Vector2d& p) {
  return pyramid.toCells(p).array().floor().cast<int>();
}

TEST(LikelihoodPyramid, AReturnIsMostLikelyInItsOwnCellAndNowhereFartherThanThree) {
  const LikelihoodPyramid pyramid({{{0.32, -0.71}}}, {0.0, 0.0}, 5.0, 0, kCell);
  const Eigen::Vector2i own = cellOf(pyramid, {0.32, -0.71});
  for (int dy = -5; dy <= 5; ++dy) {
    for (int dx = -5; dx <= 5; ++dx) {
      const double d = std::hypot(dx, dy) / LikelihoodPyramid::kSigma;
      const bool is_far = std::max(std::abs(dx), std::abs(dy)) > 3;
      const double expected = is_far ? 0.0 : 255.0 * std::exp(-0.5 * d * d);
      EXPECT_NEAR(pyramid.at(0, 0, own.x() + dx, own.y() + dy), expected, 0.51) << dx << " " << dy;
    }
  }
}

TEST(LikelihoodPyramid, ACoarseCellHoldsTheLargestOfTheFineOnesThatBeginThere) {
  const LikelihoodPyramid pyramid(returns(), {0.0, 0.0}, 5.0, 4, kCell);
  ASSERT_EQ(pyramid.levels(), 5);
  for (int level = 1; level < pyramid.levels(); ++level) {
    const int size = 1 << level;
    for (int y = -size; y < 60; ++y) {
      for (int x = -size; x < 60; ++x) {
        int largest = 0;
        for (int dy = 0; dy < size; ++dy) {
          for (int dx = 0; dx < size; ++dx)
            largest = std::max<int>(largest, pyramid.at(0, 0, x + dx, y + dy));
        }
        ASSERT_EQ(pyramid.at(level, 0, x, y), largest) << level << ": " << x << " " << y;
      }
    }
  }
}

TEST(LikelihoodPyramid, AReturnStandsInTheLayersOfItsDirectionAndThatOfNoneInNone) {
  const Eigen::Vector2d p(0.3, 0.4), q(2.3, 0.4);
  const LikelihoodPyramid pyramid({{p, Eigen::Vector2d(1.0, 0.1).normalized()}, {q}}, {0.0, 0.0},
                                  5.0, 0, kCell, LikelihoodPyramid::Facing::kAlike);
  const Eigen::Vector2i at = cellOf(pyramid, p), nowhere = cellOf(pyramid, q);
  EXPECT_EQ(pyramid.at(0, pyramid.layerOf(0.0), at.x(), at.y()), 255);
  EXPECT_EQ(pyramid.at(0, pyramid.layerOf(2.0 * M_PI + 0.1), at.x(), at.y()), 255);
  EXPECT_EQ(pyramid.at(0, pyramid.layerOf(M_PI_2), at.x(), at.y()), 0);
  EXPECT_EQ(pyramid.at(0, pyramid.layerOf(M_PI), at.x(), at.y()), 0);
  for (int layer = 0; layer < 8; ++layer)
    EXPECT_EQ(pyramid.at(0, layer, nowhere.x(), nowhere.y()), 0) << layer;
}

TEST(LikelihoodPyramid, OffsetsLeadToTheSameCells) {
  const LikelihoodPyramid pyramid(returns(), {0.0, 0.0}, 5.0, 3, kCell,
                                  LikelihoodPyramid::Facing::kAlike);
  EXPECT_TRUE(pyramid.covers(-8, -8, 20, 20));
  EXPECT_FALSE(pyramid.covers(-8, -8, 20, 2000));
  EXPECT_FALSE(pyramid.covers(-2000, -8, 20, 20));
  for (int level = 0; level < pyramid.levels(); ++level) {
    for (int layer = 0; layer < 8; ++layer) {
      for (int y = -8; y <= 20; ++y) {
        for (int x = -8; x <= 20; ++x) {
          ASSERT_EQ(pyramid.level(level)[pyramid.offset(x, y, layer)],
                    pyramid.at(level, layer, x, y));
        }
      }
    }
  }
}

TEST(LikelihoodPyramid, WhatLiesBeyondTheReachIsNotDrawn) {
  const LikelihoodPyramid pyramid({{{0.0, 0.0}}, {{9.0, 0.0}}}, {0.0, 0.0}, 5.0, 0, kCell);
  const Eigen::Vector2i far = cellOf(pyramid, {9.0, 0.0});
  EXPECT_EQ(pyramid.at(0, 0, far.x(), far.y()), 0);
}

TEST(LikelihoodPyramid, OfReturnsInOneCellTheFirstIsKept) {
  const auto kept = thinned({{{0.01, 0.01}}, {{0.09, 0.02}}, {{-0.01, 0.01}}}, 0.1);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].position.x(), 0.01);
  EXPECT_EQ(kept[1].position.x(), -0.01);
}

}  // namespace
}  // namespace cca
