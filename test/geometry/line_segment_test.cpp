// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/line_segment.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cca {
namespace {

std::vector<Eigen::Vector2d> cloud(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < n; ++i) {
    points.emplace_back(5.0 + 3.0 * normal(random), -2.0 + 0.5 * normal(random));
  }
  return points;
}

TEST(PointMoments, OfPartsAddUpToThoseOfTheWhole) {
  const auto points = cloud(100, 1);
  PointMoments whole, left, right;
  for (std::size_t i = 0; i < points.size(); ++i) {
    whole.add(points[i]);
    (i < 37 ? left : right).add(points[i]);
  }
  left.add(right);
  EXPECT_DOUBLE_EQ(left.weight, 100.0);
  EXPECT_NEAR((left.mean - whole.mean).norm(), 0.0, 1e-12);
  EXPECT_NEAR((left.scatter - whole.scatter).norm(), 0.0, 1e-9);
}

TEST(PrefixMoments, GiveTheMomentsOfAnyRun) {
  const auto points = cloud(60, 2);
  const PrefixMoments prefix(points);
  for (int first = 0; first < 60; first += 7) {
    for (int last = first; last <= 60; last += 5) {
      PointMoments truth;
      for (int i = first; i < last; ++i) truth.add(points[i]);
      const PointMoments run = prefix.run(first, last);
      EXPECT_DOUBLE_EQ(run.weight, truth.weight);
      EXPECT_NEAR((run.mean - truth.mean).norm(), 0.0, 1e-10);
      EXPECT_NEAR((run.scatter - truth.scatter).norm(), 0.0, 1e-8);
    }
  }
}

TEST(FitLine, IsBeatenByNoOtherDirection) {
  const auto points = cloud(50, 3);
  PointMoments moments;
  for (const auto& p : points) moments.add(p);
  const FittedLine line = fitLine(moments);
  for (double angle = 0.0; angle < M_PI; angle += 0.001) {
    double sum = 0.0;
    for (const auto& p : points) {
      const double d =
          -std::sin(angle) * (p - moments.mean).x() + std::cos(angle) * (p - moments.mean).y();
      sum += d * d;
    }
    EXPECT_GE(sum, line.residual_sum_sq - 1e-9);
  }
}

TEST(FitLine, FindsEveryDirectionToTheLastDigits) {
  for (double angle = -M_PI; angle < M_PI; angle += 0.01) {
    PointMoments moments;
    const Eigen::Vector2d u(std::cos(angle), std::sin(angle));
    for (int i = -3; i <= 3; ++i) moments.add(Eigen::Vector2d(1.0, 2.0) + 0.3 * i * u);
    const FittedLine line = fitLine(moments);
    EXPECT_NEAR(line.direction.x() * u.y() - line.direction.y() * u.x(), 0.0, 1e-7);
    EXPECT_NEAR(line.direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(line.residual_sum_sq, 0.0, 1e-12);
  }
}

TEST(FitLine, OfCoincidentPointsHasADirectionAllTheSame) {
  PointMoments moments;
  for (int i = 0; i < 5; ++i) moments.add(Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(fitLine(moments).direction, Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(fitLine(PointMoments()).residual_sum_sq, 0.0);
}

TEST(Intersection, LiesOnBothLines) {
  const FittedLine a{{1.0, 2.0}, {1.0, 0.0}}, b{{4.0, -3.0}, {0.6, 0.8}};
  const auto p = intersection(a, b);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->y(), 2.0, 1e-12);
  EXPECT_NEAR(p->x(), 4.0 + 5.0 * 0.75, 1e-12);
  const auto q = intersection(b, a);
  ASSERT_TRUE(q);
  EXPECT_NEAR((*p - *q).norm(), 0.0, 1e-12);
}

TEST(Intersection, IsNowhereForParallelLines) {
  const FittedLine a{{1.0, 2.0}, {1.0, 0.0}}, b{{1.0, 3.0}, {-1.0, 0.0}};
  EXPECT_FALSE(intersection(a, b));
  EXPECT_FALSE(intersection(a, a));
}

}  // namespace
}  // namespace cca
