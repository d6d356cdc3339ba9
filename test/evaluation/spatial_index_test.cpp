// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/spatial_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace cca {
namespace {

std::vector<Segment2> randomSegments(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-5.0, 5.0), part(-1.0, 1.0);
  std::vector<Segment2> segments;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d start(place(random), place(random));
    segments.push_back({start, start + Eigen::Vector2d(part(random), part(random))});
  }
  return segments;
}

std::vector<Eigen::Vector2d> randomPoints(int n, unsigned seed) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& s : randomSegments(n, seed)) points.push_back(s.start);
  return points;
}

TEST(Distance, IsToTheNearestPointOfTheSegment) {
  const Segment2 s{{0.0, 0.0}, {2.0, 0.0}};
  EXPECT_DOUBLE_EQ(distance({1.0, 3.0}, s), 3.0);
  EXPECT_DOUBLE_EQ(distance({-3.0, 4.0}, s), 5.0);
  EXPECT_DOUBLE_EQ(distance({3.0, 0.0}, {{0.0, 0.0}, {0.0, 0.0}}), 3.0);
}

TEST(SegmentIndex, FindsWhatALookAtEverySegmentFinds) {
  const auto segments = randomSegments(300, 1);
  const SegmentIndex index(segments);
  for (const auto& p : randomPoints(200, 2)) {
    std::vector<std::size_t> near;
    std::size_t best = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (distance(p, segments[i]) <= 0.5) near.push_back(i);
      if (distance(p, segments[i]) < distance(p, segments[best])) best = i;
    }
    EXPECT_EQ(index.within(p, 0.5), near);
    const Neighbour nearest = index.nearest(p, 100.0);
    EXPECT_EQ(nearest.index, best);
    EXPECT_DOUBLE_EQ(nearest.distance, distance(p, segments[best]));
  }
}

TEST(SegmentIndex, CapsTheDistance) {
  const SegmentIndex index({{{0.0, 0.0}, {1.0, 0.0}}});
  EXPECT_EQ(index.nearest({0.5, 2.0}, 1.0).index, SegmentIndex::npos);
  EXPECT_DOUBLE_EQ(index.nearest({0.5, 2.0}, 1.0).distance, 1.0);
  EXPECT_EQ(SegmentIndex({}).nearest({0.0, 0.0}, 1.0).index, SegmentIndex::npos);
}

TEST(SegmentIndex, MeasuresBetweenSegmentsThatCross) {
  const SegmentIndex index({{{-1.0, 0.0}, {1.0, 0.0}}, {{-1.0, 5.0}, {1.0, 5.0}}});
  EXPECT_EQ(index.within(Segment2{{0.0, -1.0}, {0.0, 1.0}}, 0.1), std::vector<std::size_t>{0});
  EXPECT_EQ(index.within(Segment2{{0.0, -1.0}, {0.0, 4.5}}, 0.6).size(), 2u);
}

TEST(PointIndex, FindsWhatALookAtEveryPointFinds) {
  const auto points = randomPoints(500, 3);
  const PointIndex index(points);
  std::vector<std::size_t> found;
  for (const auto& p : randomPoints(100, 4)) {
    std::vector<std::size_t> near;
    double best = 100.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      best = std::min(best, (points[i] - p).norm());
      if ((points[i] - p).norm() <= 0.7) near.push_back(i);
    }
    index.within(p, 0.7, found);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, near);
    EXPECT_DOUBLE_EQ(index.nearestDistance(p, 100.0), best);
  }
}

TEST(PointIndex, CountsAPointAtExactlyTheRadius) {
  const std::vector<Eigen::Vector2d> points{{0.25, 0.0}};
  std::vector<std::size_t> found;
  PointIndex(points).within({0.0, 0.0}, 0.25, found);
  EXPECT_EQ(found.size(), 1u);
}

TEST(PointIndex, OfNothingFindsNothing) {
  const std::vector<Eigen::Vector2d> none;
  const PointIndex index(none);
  std::vector<std::size_t> found{7};
  index.within({0.0, 0.0}, 1.0, found);
  EXPECT_TRUE(found.empty());
  EXPECT_DOUBLE_EQ(index.nearestDistance({0.0, 0.0}, 2.5), 2.5);
}

}  // namespace
}  // namespace cca
