// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapped_world.hpp"

namespace cca {
namespace {

TEST(LineMap, ADoorThatOpensLeavesItsWallWhole) {
  SegmentWorld shut = room(), open = room();
  shut.walls.push_back({{-4.0, 2.0}, {4.0, 2.0}});
  open.walls.push_back({{-4.0, 2.0}, {0.0, 2.0}});
  open.walls.push_back({{1.0, 2.0}, {4.0, 2.0}});
  LineMap map;
  std::mt19937 random(4);
  drive(map, shut, random);
  drive(map, open, random, 0.01, 80);
  for (const Eigen::Vector2d& p : pointsOn(map.lines())) {
    EXPECT_FALSE(p.x() > 0.1 && p.x() < 0.9 && std::abs(p.y() - 2.0) < 0.2) << p.transpose();
  }
  SegmentWorld jambs;
  jambs.walls.push_back({{-3.8, 2.0}, {-0.1, 2.0}});
  jambs.walls.push_back({{1.1, 2.0}, {3.8, 2.0}});
  EXPECT_GT(recall(jambs, map.lines(), 0.03), 0.97);
}

TEST(LineMap, NothingIsLeftOfMoversAndNoWallIsLost) {
  LineMap map;
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    SegmentWorld world = room();
    const double x = -3.0 + 0.1 * i, y = -2.0 + 0.05 * i;  // a crate and a door leaf on their way
    world.box(x, 1.5, x + 0.5, 2.0);
    world.walls.push_back({{y, -2.0}, {y + 0.4, -1.4}});
    map.insert(world.scan({0.0, 0.0, 0.1 * i}, 0.01, random));
  }
  drive(map, room(), random);
  for (const Eigen::Vector2d& p : pointsOn(map.lines())) {
    EXPECT_LT(room().distance(p), 0.05) << p.transpose();
  }
  EXPECT_GT(recall(room(), map.lines(), 0.02), 0.99);
}

/// A partition that returns no beam parts a room; the robot is on one side, then on the other.
TEST(LineMap, WhatStandsBehindADarkSurfaceStays) {
  const SegmentWorld lit = room();
  SegmentWorld dark;
  dark.walls.push_back({{0.0, -3.0}, {0.0, 3.0}});
  LineMap map;
  std::mt19937 random(6);
  for (int i = 0; i < 120; ++i) {
    const Pose2 pose{(i < 40 ? 2.0 : -2.0) + 0.01 * i, -0.5, 0.1 * i};
    Scan scan = lit.scan(pose, 0.01, random);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const double angle = pose.theta + scan.bearing(beam);
      const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
      if (std::isfinite(dark.range(pose.position(), ray, scan.ranges[beam]))) {
        scan.ranges[beam] = std::numeric_limits<double>::infinity();
      }
    }
    map.insert(scan);
  }
  EXPECT_GT(recall(lit, map.lines(), 0.03), 0.99);
}

/// A robot sees free floor for thirty scans, and a crate on it for ten.
TEST(LineMap, InHindsightRaysRefuteWhatCameAfterThem) {
  SegmentWorld with_crate = room();
  with_crate.box(1.5, 0.5, 2.1, 1.1);
  LineMap map;
  PastScans past;
  std::mt19937 random(8);
  for (int i = 0; i < 40; ++i) {
    const Pose2 pose{-2.5 + 0.06 * i, -1.0, 0.1 * i};
    const Scan scan = (i < 30 ? room() : with_crate).scan(pose, 0.01, random);
    past.add({scan, {}, {}}, pose);
    map.insert(scan);
  }
  const auto farthestFromAWall = [&map] {
    double farthest = 0.0;
    for (const Eigen::Vector2d& p : pointsOn(map.lines())) {
      farthest = std::max(farthest, room().distance(p));
    }
    return farthest;
  };
  EXPECT_GT(farthestFromAWall(), 0.5) << "the crate is in the map while the robot stands before it";
  map.lookBack(past.kept());
  EXPECT_LT(farthestFromAWall(), 0.05);
  EXPECT_GT(recall(room(), map.lines(), 0.02), 0.99);
}

/// The scans kept have lost all beams to one side.
TEST(LineMap, InHindsightWhatOnlyScansThatWereNotKeptHaveSeenStays) {
  LineMap map;
  PastScans past;
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    const Pose2 pose{-2.0 + 0.06 * i, -0.5, 0.0};
    Scan scan = room().scan(pose, 0.01, random);
    map.insert(scan);
    std::fill_n(scan.ranges.begin(), scan.size() / 2, 0.0);
    past.add({scan, {}, {}}, pose);
  }
  ASSERT_GT(past.kept().size(), 10U);
  map.lookBack(past.kept());
  EXPECT_GT(recall(room(), map.lines(), 0.02), 0.99);
}

TEST(LineMap, IdsStayWhileTheWallIsSeenAgain) {
  LineMap map;
  std::mt19937 random(6);
  drive(map, room(), random);
  const std::vector<MapLine> before = map.lines();
  drive(map, room(), random);
  const std::vector<MapLine> after = map.lines();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].id, after[i].id);
    EXPECT_LT((before[i].segment.start - after[i].segment.start).norm(), 0.05);
  }
}

/// A crate that stands in the room in every tenth round only: rays went through its place ten times
/// as often as they ended there.
TEST(LineMap, WhatComesBackToAFreedPlaceHasToOutweighWhatWentThrough) {
  SegmentWorld furnished = room();
  furnished.box(2.0, -0.5, 2.5, 0.5);
  const auto crateLength = [](const LineMap& map) {
    double length = 0.0;
    for (const MapLine& line : map.lines()) {
      if (room().distance(line.segment.start) > 0.3) length += line.segment.length();
    }
    return length;
  };
  LineMap map;
  std::mt19937 random(16);
  const auto look = [&](const SegmentWorld& world, int scans) {
    for (int i = 0; i < scans; ++i) map.insert(world.scan({0.0, 0.02 * i, 0.1 * i}, 0.01, random));
  };
  look(furnished, 2);
  EXPECT_GT(crateLength(map), 0.9);
  look(room(), 18);
  EXPECT_EQ(crateLength(map), 0.0);
  look(furnished, 2);
  EXPECT_EQ(crateLength(map), 0.0);  // a passer-by
  look(furnished, 10);
  EXPECT_GT(crateLength(map), 0.9);  // here to stay
}

}  // namespace
}  // namespace cca
