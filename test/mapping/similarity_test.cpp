// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/similarity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace cca {
namespace {

constexpr double kSigma = 0.03;
const double kLinePrice = linePrice(CcaParameters().vertex_price);

/// n points from `from` to `to`, with residuals of alternating sign.
PointMoments wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int n) {
  const Eigen::Vector2d u = (to - from).normalized(), normal(-u.y(), u.x());
  PointMoments moments;
  for (int i = 0; i < n; ++i) {
    const double residual = (i % 2 == 0 ? 0.5 : -0.5) * kSigma;
    moments.add(from + (to - from) * i / (n - 1.0) + residual * normal);
  }
  return moments;
}

FittedSegment fitted(const PointMoments& moments) {
  return {moments, fitLine(moments), {kSigma * kSigma, 0.0}, kLinePrice};
}

Memberships between(const PointMoments& a, const PointMoments& b, double gap = 0.0) {
  PointMoments joint = a;
  joint.add(b);
  return memberships(fitted(a), fitted(b), fitted(joint), gap, kLinePrice);
}

TEST(Memberships, OfTwoPiecesOfOneWallAreAllNearOne) {
  const Memberships mu = between(wall({0, 1}, {1, 1}, 10), wall({1.1, 1}, {2, 1}, 10));
  EXPECT_GT(mu.similarity(), 0.9);
}

TEST(Memberships, FallWithTheAngle) {
  double before = 1.0;
  for (double angle = 0.0; angle < 1.0; angle += 0.05) {
    const Eigen::Vector2d u(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d corner(1.0, 1.0);
    const Memberships mu =
        between(wall({0, 1}, corner, 20), wall(corner + 0.05 * u, corner + u, 20));
    EXPECT_LE(mu.fit, before + 1e-9);
    before = mu.fit;
    if (angle > 0.3) {
      EXPECT_LT(mu.similarity(), 0.5);
    }
  }
}

TEST(Memberships, FallWithTheOffsetOfParallelWalls) {
  const Memberships near = between(wall({0, 1}, {1, 1}, 20), wall({1.1, 1.01}, {2, 1.01}, 20));
  const Memberships far = between(wall({0, 1}, {1, 1}, 20), wall({1.1, 1.4}, {2, 1.4}, 20));
  EXPECT_GT(near.similarity(), 0.5);
  EXPECT_LT(far.fit, 0.5);
}

TEST(Memberships, LetNoRayPassBetweenPiecesOfOneWall) {
  const PointMoments a = wall({0, 1}, {1, 1}, 10), b = wall({2, 1}, {3, 1}, 10);
  EXPECT_GT(between(a, b, 0.5).similarity(), 0.5);
  EXPECT_LT(between(a, b, 1.1).similarity(), 0.5);
  EXPECT_EQ(between(a, b, std::numeric_limits<double>::infinity()).similarity(), 0.0);
}

TEST(Memberships, KeepTheTwoFacesOfAThinWallApart) {
  const PointMoments front = wall({0, 1}, {3, 1}, 60), back = wall({0, 1.06}, {3, 1.06}, 60);
  EXPECT_LT(between(front, back).similarity(), 0.5);
  EXPECT_GT(between(front, wall({0.02, 1.0}, {3.02, 1.0}, 60)).similarity(), 0.9);
}

TEST(Memberships, AreSymmetricAndWithinZeroAndOne) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> c(-3.0, 3.0);
  for (int trial = 0; trial < 500; ++trial) {
    const PointMoments a = wall({c(random), c(random)}, {c(random), c(random)}, 2 + trial % 9);
    const PointMoments b = wall({c(random), c(random)}, {c(random), c(random)}, 2 + trial % 5);
    const Memberships ab = between(a, b, 0.3), ba = between(b, a, 0.3);
    EXPECT_NEAR(ab.similarity(), ba.similarity(), 1e-9);
    for (const double mu : {ab.orientation, ab.offset, ab.gap, ab.fit, ab.overlap}) {
      EXPECT_GE(mu, 0.0);
      EXPECT_LE(mu, 1.0);
    }
  }
}

TEST(Memberships, DoNotChangeUnderRigidMotion) {
  const Eigen::Vector2d shift(7.0, -3.0);
  for (double angle = 0.0; angle < 6.0; angle += 0.7) {
    Eigen::Matrix2d R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const auto moved = [&](double x, double y) {
      return Eigen::Vector2d(R * Eigen::Vector2d(x, y) + shift);
    };
    const Memberships here = between(wall({0, 1}, {1, 1.0}, 12), wall({1.2, 1.05}, {2, 1.1}, 9));
    const Memberships there =
        between(wall(moved(0, 1), moved(1, 1.0), 12), wall(moved(1.2, 1.05), moved(2, 1.1), 9));
    EXPECT_NEAR(here.similarity(), there.similarity(), 1e-6);
  }
}

TEST(FitMembership, IsOneHalfWhereOneLineTellsAsBrieflyAsTwo) {
  // Two walls at an offset that is searched for: there the prices of one and of two are equal.
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double offset = 0.5 * (low + high);
    const PointMoments a = wall({0, 1}, {1, 1}, 20),
                       b = wall({1.1, 1 + offset}, {2, 1 + offset}, 20);
    PointMoments joint = a;
    joint.add(b);
    const bool one_is_briefer = fitted(joint).price < fitted(a).price + fitted(b).price;
    (one_is_briefer ? low : high) = offset;
  }
  const PointMoments a = wall({0, 1}, {1, 1}, 20), b = wall({1.1, 1 + low}, {2, 1 + low}, 20);
  EXPECT_NEAR(between(a, b).fit, 0.5, 1e-3);
}

TEST(FitMembership, TakesNoWallForBentBecauseItIsMetAtManyAngles) {
  // Seen from its foot, a wall of 6 m shows less and less of its range noise across.
  const PointNoise noise{0.1, 0.001};
  std::mt19937 random(6);
  std::normal_distribution<double> range_error(0.0, noise.range_sigma);
  const int n = 200;
  int parted = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < n; ++i) {
      const double bearing = std::atan(6.0) * i / (n - 1.0);
      const double range = 1.0 / std::cos(bearing) + range_error(random);
      points.emplace_back(range * std::sin(bearing), range * std::cos(bearing));
    }
    const RunFitter fitter(points, noise);
    const FittedRun a = fitter.fit(0, n / 2), b = fitter.fit(n / 2, n), joint = fitter.fit(0, n);
    parted += fitMembership(a, b, joint, kLinePrice) < 0.5 ? 1 : 0;
  }
  EXPECT_LE(parted, 2);
}

TEST(FitMembership, OfTwoStrayPointsIsZero) {
  PointMoments a, b;
  a.add(Eigen::Vector2d(1.0, 0.0));
  b.add(Eigen::Vector2d(1.0, 0.1));
  PointMoments joint = a;
  joint.add(b);
  EXPECT_EQ(fitMembership(fitted(a), fitted(b), fitted(joint), kLinePrice), 0.0);
}

}  // namespace
}  // namespace cca
