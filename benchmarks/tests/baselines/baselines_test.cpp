// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "baselines/fitted_circle.hpp"
#include "baselines/registry.hpp"

namespace cca::baselines {
namespace {

using Wall = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

double rangeTo(const Wall& wall, double bearing) {
  const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing)), d = wall.second - wall.first;
  const double across = u.x() * d.y() - u.y() * d.x();
  if (std::abs(across) < 1e-12) return INFINITY;
  const double range = (wall.first.x() * d.y() - wall.first.y() * d.x()) / across;
  const double along = (wall.first.x() * u.y() - wall.first.y() * u.x()) / across;
  return range > 0.0 && along >= 0.0 && along <= 1.0 ? range : INFINITY;
}

/// 361 beams over the full turn, from -180 degrees, starting behind the robot.
Scan scanOf(const std::vector<Wall>& walls, double noise, unsigned seed = 7, int beams = 361) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss;
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = 2.0 * M_PI / beams;
  for (int i = 0; i < beams; ++i) {
    double range = INFINITY;
    for (const Wall& wall : walls) {
      range = std::min(range, rangeTo(wall, scan.bearing(static_cast<std::size_t>(i))));
    }
    scan.ranges.push_back(range + noise * gauss(random));
  }
  return scan;
}

double lateralError(const LineSegment& segment, const Wall& wall) {
  const Eigen::Vector2d along = (wall.second - wall.first).normalized();
  const Eigen::Vector2d offset = 0.5 * (segment.start + segment.end) - wall.first;
  return std::abs(along.x() * offset.y() - along.y() * offset.x());
}

double angularError(const LineSegment& segment, const Wall& wall) {
  const Eigen::Vector2d u = (wall.second - wall.first).normalized(), v = segment.direction();
  return std::asin(std::min(1.0, std::abs(u.x() * v.y() - u.y() * v.x())));
}

/// The one segment that describes the wall: near, parallel, and nearly as long.
void expectFound(const std::vector<LineSegment>& segments, const Wall& wall, double lateral,
                 double angular, double shorter_by) {
  const double length = (wall.second - wall.first).norm();
  const auto describes = [&](const LineSegment& s) {
    return lateralError(s, wall) < lateral && angularError(s, wall) < angular &&
           std::abs(s.length() - length) < shorter_by;
  };
  EXPECT_EQ(std::count_if(segments.begin(), segments.end(), describes), 1)
      << "wall " << wall.first.transpose() << " to " << wall.second.transpose();
}

const Wall kWall{{2.0, -1.5}, {2.0, 1.5}};
const std::vector<Wall> kCorner{{{2.0, -2.0}, {2.0, 2.0}}, {{2.0, 2.0}, {-1.0, 2.0}}};
const std::vector<Wall> kCorridor{{{-4.0, 1.0}, {4.0, 1.0}}, {{4.0, -1.0}, {-4.0, -1.0}}};
const std::vector<Wall> kRoom{{{3.0, -2.0}, {3.0, 2.5}},
                              {{3.0, 2.5}, {-2.5, 2.5}},
                              {{-2.5, 2.5}, {-2.5, -2.0}},
                              {{-2.5, -2.0}, {3.0, -2.0}}};

class EachBaseline : public testing::TestWithParam<Baseline> {};

TEST_P(EachBaseline, RecoversAWallExactlyWithoutNoise) {
  const auto segments = GetParam().recommended(scanOf({kWall}, 0.0));
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_LT(lateralError(segments[0], kWall), 1e-9);
  EXPECT_LT(angularError(segments[0], kWall), 1e-9);
  // The outermost beams lie at most one beam spacing (2.5 m * 1 deg / cos 37 deg) inside the ends.
  EXPECT_NEAR(segments[0].length(), 3.0, 0.14);
}

TEST_P(EachBaseline, RecoversBothWallsOfARightAngle) {
  const auto segments = GetParam().recommended(scanOf(kCorner, 0.005));
  EXPECT_EQ(segments.size(), 2u);
  for (const Wall& wall : kCorner) expectFound(segments, wall, 0.03, 0.03, 0.35);
}

TEST_P(EachBaseline, RecoversBothSidesOfACorridor) {
  const auto segments = GetParam().recommended(scanOf(kCorridor, 0.005));
  for (const Wall& wall : kCorridor) expectFound(segments, wall, 0.03, 0.02, 1.5);
}

TEST_P(EachBaseline, RecoversARoomUnderNoise) {
  const auto segments = GetParam().recommended(scanOf(kRoom, 0.01));
  int found = 0;
  for (const Wall& wall : kRoom) {
    for (const LineSegment& s : segments) {
      found += lateralError(s, wall) < 0.05 && angularError(s, wall) < 0.05 && s.length() > 1.5;
    }
  }
  EXPECT_GE(found, 4);
}

TEST_P(EachBaseline, TurnsWithTheSensor) {
  Scan turned = scanOf({kWall}, 0.0);
  turned.angle_min += 0.4;
  const auto segments = GetParam().recommended(turned);
  ASSERT_EQ(segments.size(), 1u);
  const Pose2 turn{0.0, 0.0, 0.4};
  EXPECT_LT(lateralError(segments[0], {turn * kWall.first, turn * kWall.second}), 1e-9);
}

TEST_P(EachBaseline, GivesTheSameTwice) {
  const Scan scan = scanOf(kRoom, 0.02);
  for (const auto& extract : {GetParam().recommended, GetParam().tuned}) {
    const auto first = extract(scan), second = extract(scan);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(first[i].start, second[i].start);
      EXPECT_EQ(first[i].end, second[i].end);
    }
  }
}

TEST_P(EachBaseline, FindsNothingWhereThereIsNothing) {
  Scan scan;
  scan.angle_increment = 0.01;
  for (const auto& extract : {GetParam().recommended, GetParam().tuned}) {
    scan.ranges.clear();
    EXPECT_TRUE(extract(scan).empty());
    scan.ranges = {1.0};
    EXPECT_TRUE(extract(scan).empty());
    scan.ranges.assign(361, INFINITY);
    EXPECT_TRUE(extract(scan).empty());
    scan.ranges.assign(361, std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(extract(scan).empty());
  }
}

TEST_P(EachBaseline, StaysFiniteOnScatterAndOnRandomParameters) {
  std::mt19937_64 random(3);
  Scan scan = scanOf(kRoom, 0.02);
  for (double& range : scan.ranges) {
    if (random() % 3 == 0) range = 0.1 + static_cast<double>(random() % 1000) / 100.0;
    if (random() % 17 == 0) range = INFINITY;
  }
  for (int draw = 0; draw < 5; ++draw) {
    const Candidate candidate = GetParam().sample(random);
    for (const LineSegment& s : candidate.extract(scan)) {
      EXPECT_TRUE(s.start.allFinite() && s.end.allFinite()) << candidate.parameters;
      EXPECT_TRUE(s.covariance.allFinite()) << candidate.parameters;
      EXPECT_GT(s.length(), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachBaseline, testing::ValuesIn(all()), [](const auto& parameter) {
  std::string name = parameter.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// The near side of a round pillar, 2 m ahead.
Scan scanOfPillar(double radius, double noise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss;
  Scan scan;
  const double half = 0.98 * std::asin(radius / 2.0);
  const int beams = 61;
  scan.angle_min = -half;
  scan.angle_increment = 2.0 * half / (beams - 1);
  for (std::size_t i = 0; i < beams; ++i) {
    const double along = 2.0 * std::cos(scan.bearing(i));
    const double range = along - std::sqrt(along * along - 4.0 + radius * radius);
    scan.ranges.push_back(range + noise * gauss(random));
  }
  return scan;
}

TEST(Baselines, ACircleIsFoundExactlyWithoutNoise) {
  const Points points = returnedPoints(scanOfPillar(0.6, 0.0));
  const auto circle = fitCircle(points, {0, points.size()});
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->radius, 0.6, 1e-9);
  EXPECT_LT((circle->centre - Eigen::Vector2d(2.0, 0.0)).norm(), 1e-9);
  EXPECT_TRUE(isRound(points, {0, points.size()}, 1.0));
  EXPECT_FALSE(isRound(points, {0, points.size()}, 0.5));
  const Points wall{{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}};
  EXPECT_FALSE(isRound(wall, {0, wall.size()}, 1.0));
}

TEST(Baselines, ExtractorsWithCirclesTakeAPillarForNoWall) {
  for (const Baseline& b : all()) {
    if (b.name != "predicted-features" && b.name != "kalman-grouping") continue;
    EXPECT_TRUE(b.recommended(scanOfPillar(0.6, 0.002)).empty()) << b.name;
  }
}

/// Mean lateral error over random rooms falls with the noise, and for the least-squares methods
/// stays of its magnitude: Nguyen et al. report about 2 cm for a laser of 3 cm.
TEST(Baselines, AccuracyFollowsTheNoise) {
  for (const Baseline& b : all()) {
    double last = 0.0;
    for (const double noise : {0.0, 0.01, 0.03}) {
      double sum = 0.0;
      int count = 0;
      for (unsigned seed = 1; seed <= 5; ++seed) {
        for (const LineSegment& s : b.recommended(scanOf({kWall}, noise, seed))) {
          if (s.length() < 1.0) continue;
          sum += lateralError(s, kWall);
          ++count;
        }
      }
      ASSERT_TRUE(count > 0 || noise > 0.0) << b.name;
      if (count == 0) continue;  // a noisy wall falls to short pieces
      EXPECT_GE(sum / count + 1e-9, last) << b.name;
      EXPECT_LE(sum / count, noise + 1e-9) << b.name;
      last = sum / count;
    }
  }
}

}  // namespace
}  // namespace cca::baselines
