// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/point_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "polygon_room.hpp"

namespace cca {
namespace {

std::vector<SpatialPoint> wallPoints(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int n,
                                     double sigma, std::mt19937* random) {
  std::normal_distribution<double> noise(0.0, sigma);
  const Eigen::Vector2d u = (to - from).normalized(), normal(-u.y(), u.x());
  std::vector<SpatialPoint> points;
  for (int i = 0; i < n; ++i) {
    points.push_back({from + (to - from) * i / (n - 1.0) + noise(*random) * normal, sigma,
                      (to - from).norm() / (n - 1.0)});
  }
  return points;
}

void append(std::vector<SpatialPoint> more, std::vector<SpatialPoint>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

TEST(ExtractLinesOfPoints, RecoverBothWallsOfARightAngleAndTheirCorner) {
  std::mt19937 random(1);
  std::vector<SpatialPoint> points = wallPoints({0, 0}, {4, 0}, 80, 0.02, &random);
  append(wallPoints({0, 0.05}, {0, 3}, 60, 0.02, &random), &points);
  const auto lines = extractLines(points);
  ASSERT_EQ(lines.size(), 2u);
  const Eigen::Vector2d ends[] = {lines[0].start, lines[0].end, lines[1].start, lines[1].end};
  EXPECT_EQ(std::count_if(ends, ends + 4, [](const auto& e) { return e.norm() < 0.1; }), 2);
}

TEST(ExtractLinesOfPoints, DoNotDependOnTheirOrder) {
  std::mt19937 random(2);
  std::vector<SpatialPoint> points = wallPoints({0, 0}, {4, 0}, 80, 0.02, &random);
  append(wallPoints({0, 0.05}, {0, 3}, 60, 0.02, &random), &points);
  append(wallPoints({1, 2}, {3, 2.5}, 40, 0.02, &random), &points);
  const auto straight = extractLines(points);
  std::shuffle(points.begin(), points.end(), random);
  const auto shuffled = extractLines(points);
  ASSERT_EQ(straight.size(), shuffled.size());
  for (const LineSegment& a : straight) {
    EXPECT_TRUE(std::any_of(shuffled.begin(), shuffled.end(), [&](const LineSegment& b) {
      return (a.start - b.start).norm() < 1e-6 && (a.end - b.end).norm() < 1e-6;
    }));
  }
}

TEST(ExtractLinesOfPoints, MergeTheLayersOfOneWallAndKeepTheFacesOfAThinOne) {
  std::mt19937 random(3);
  std::vector<SpatialPoint> one = wallPoints({0, 1}, {4, 1}, 100, 0.02, &random);
  append(wallPoints({0.5, 1}, {4.5, 1}, 100, 0.02, &random), &one);
  EXPECT_EQ(extractLines(one).size(), 1u);
  std::vector<SpatialPoint> two = wallPoints({0, 1}, {4, 1}, 100, 0.02, &random);
  append(wallPoints({0, 1.15}, {4, 1.15}, 100, 0.02, &random), &two);
  EXPECT_EQ(extractLines(two).size(), 2u);
}

TEST(ExtractLinesOfPoints, LeaveADoorOpen) {
  std::mt19937 random(4);
  std::vector<SpatialPoint> points = wallPoints({0, 1}, {2, 1}, 60, 0.02, &random);
  append(wallPoints({3.5, 1}, {5.5, 1}, 60, 0.02, &random), &points);
  EXPECT_EQ(extractLines(points).size(), 2u);
}

TEST(ExtractLinesOfPoints, OfABatchOfScansAreTheWallsOfTheRoom) {
  std::mt19937 random(5);
  std::vector<SpatialPoint> points;
  for (const double x : {-0.5, 0.0, 0.5}) {
    const Scan scan = turnIn(rectangle(-3.0 - x, -2.0, 3.0 - x, 2.0), 0.02, &random);
    appendPoints(scan, {x, 0.0, 0.0}, &points);
  }
  ASSERT_EQ(points.size(), 3u * 360u);
  const auto lines = extractLines(points);
  ASSERT_EQ(lines.size(), 4u);
  for (const LineSegment& line : lines) {
    const bool upright = std::abs(line.direction().y()) > 0.5;
    EXPECT_NEAR(line.length(), upright ? 4.0 : 6.0, 0.1);
    EXPECT_NEAR(std::abs(upright ? line.start.x() : line.start.y()), upright ? 3.0 : 2.0, 0.03);
  }
}

TEST(ExtractLinesOfPoints, MoveWithThePoints) {
  std::mt19937 random(6);
  std::vector<SpatialPoint> points = wallPoints({0, 0}, {4, 0}, 80, 0.02, &random);
  append(wallPoints({0, 0.05}, {0, 3}, 60, 0.02, &random), &points);
  const Pose2 T{5.0, -2.0, 0.7};
  std::vector<SpatialPoint> moved = points;
  for (SpatialPoint& p : moved) p.position = T * p.position;
  const auto here = extractLines(points), there = extractLines(moved);
  ASSERT_EQ(here.size(), there.size());
  for (const LineSegment& a : here) {  // other seeds: the same walls, though not the same bits
    EXPECT_TRUE(std::any_of(there.begin(), there.end(), [&](const LineSegment& b) {
      const Eigen::Vector2d s = T * a.start, e = T * a.end;
      return std::min((s - b.start).norm() + (e - b.end).norm(),
                      (s - b.end).norm() + (e - b.start).norm()) < 0.1;
    }));
  }
}

TEST(ExtractLinesOfPoints, SurviveWhatIsNoWall) {
  EXPECT_TRUE(extractLines(std::vector<SpatialPoint>()).empty());
  const SpatialPoint same{{1.0, 1.0}, 0.01, 0.01};
  EXPECT_TRUE(extractLines(std::vector<SpatialPoint>(50, same)).empty());
  SpatialPoint bad = same;
  bad.position.x() = std::nan("");
  EXPECT_TRUE(extractLines(std::vector<SpatialPoint>(5, bad)).empty());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
  std::vector<SpatialPoint> cloud;
  for (int i = 0; i < 300; ++i) {
    cloud.push_back({{coordinate(random), coordinate(random)}, 0.01, 0.02});
  }
  for (const LineSegment& line : extractLines(cloud)) EXPECT_TRUE(line.start.allFinite());
}

}  // namespace
}  // namespace cca
