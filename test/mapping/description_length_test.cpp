// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/description_length.hpp"

#include <gtest/gtest.h>

#include "../sensing/polygon_room.hpp"

namespace cca {
namespace {

TEST(RunFitter, PricesARunAsItsFitDoes) {
  std::mt19937 random(4);
  const ScanPoints points = scanPoints(turnIn(rectangle(-2.0, -1.0, 3.0, 2.0), 0.03, &random));
  const RunFitter fitter(points.positions, {0.035, 0.001, 0.0});
  for (int first = 0; first < 360; first += 11) {
    for (int last = first + 1; last <= 360; last += 13) {
      EXPECT_NEAR(fitter.price(first, last), fitter.fit(first, last).price, 1e-6);
    }
  }
  EXPECT_EQ(fitter.price(5, 5), 0.0);
}

TEST(RunFitter, BoundsPricesAndResidualsFromBelow) {
  std::mt19937 random(4);
  const ScanPoints points = scanPoints(turnIn(rectangle(-2.0, -1.0, 3.0, 2.0), 0.03, &random));
  const RunFitter fitter(points.positions, {0.035, 0.001, 0.0});
  for (int first = 0; first < 360; first += 11) {
    for (int last = first + 1; last <= 360; last += 13) {
      const FittedRun run = fitter.fit(first, last);
      EXPECT_LE(fitter.leastPrice(first, last), run.price + 1e-6);
      const double bound = fitter.leastHalfChiSquare(first, last);
      EXPECT_LE(bound, 0.5 * run.chi_square + 1e-6);
      EXPECT_NEAR(fitter.prefix().leastResidual(first, last), leastResidual(run.moments), 1e-9);
    }
  }
}

TEST(RunFitter, TakesNoTwoPointsAndNoHeapForALine) {
  const std::vector<Eigen::Vector2d> points = {{1, 0}, {1, 1}, {2, 2}, {2, 2}, {2, 2}, {2, 2}};
  const RunFitter fitter(points, {0.01, 0.001, 0.0});
  EXPECT_FALSE(fitter.fit(0, 2).is_line);
  EXPECT_FALSE(fitter.fit(2, 6).is_line);
}

TEST(RunFitter, TellsThreePointsOfAWallByALineAndThreeScatteredOnesAlone) {
  const RunFitter wall({{1, 0}, {1, 1}, {1, 2}}, {0.01, 0.001, 0.0});
  EXPECT_TRUE(wall.fit(0, 3).is_line);
  EXPECT_NEAR(wall.fit(0, 3).price, wall.linePrice(), 1e-9);
  const RunFitter clutter({{1, 0}, {1.5, 1}, {1, 2}}, {0.01, 0.001, 0.0});
  EXPECT_FALSE(clutter.fit(0, 3).is_line);
  EXPECT_NEAR(clutter.fit(0, 3).price, 3.0 * kPointPrice, 1e-9);
}

TEST(RunFitter, TellsAWallOfThreePointsAloneWhereAVertexIsDear) {
  const std::vector<Eigen::Vector2d> points{{1, 0}, {1, 1}, {1, 2}};
  const PointNoise noise{0.01, 0.001, 0.0};
  EXPECT_TRUE(RunFitter(points, noise, 12.0).fit(0, 3).is_line);   // 16 nats, three points alone 27
  EXPECT_FALSE(RunFitter(points, noise, 21.0).fit(0, 3).is_line);  // 28
  EXPECT_EQ(RunFitter(points, noise, 21.0).price(0, 3), 3.0 * kPointPrice);
}

}  // namespace
}  // namespace cca
