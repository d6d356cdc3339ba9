// SPDX-License-Identifier: BSD-3-Clause
//
// Walls that no single scan shows: rows of posts, and panes that few beams return from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mapped_world.hpp"

namespace cca {
namespace {

constexpr double kHall = 9.0;  // m, half of its length

struct Hall {
  SegmentWorld solid;  ///< what returns always
  SegmentWorld pane;   ///< one beam in five
};

Hall emptyHall() {
  Hall hall;
  hall.solid.box(-kHall, -5.0, kHall, 5.0);
  return hall;
}

/// Square posts of 5 cm on a line, 1 to 1.5 m apart.
void addPosts(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::mt19937& random,
              SegmentWorld* world) {
  std::uniform_real_distribution<double> gap(1.0, 1.5);
  const Eigen::Vector2d u = (to - from).normalized();
  for (double t = 0.0; t <= (to - from).norm(); t += gap(random)) {
    const Eigen::Vector2d p = from + t * u;
    world->box(p.x() - 0.025, p.y() - 0.025, p.x() + 0.025, p.y() + 0.025);
  }
}

Scan look(const Hall& hall, const Pose2& pose, std::mt19937& random) {
  Scan scan = hall.solid.scan(pose, 0.01, random);
  const Scan pane = hall.pane.scan(pose, 0.01, random);
  std::bernoulli_distribution returns(0.2);
  for (std::size_t k = 0; k < scan.size(); ++k) {
    if (pane.ranges[k] < scan.ranges[k] && returns(random)) scan.ranges[k] = pane.ranges[k];
  }
  return scan;
}

/// Up one side of the hall and down the other.
LineMap mapOf(const Hall& hall, std::mt19937& random) {
  LineMap map;
  for (const double side : {-2.5, 2.5}) {
    for (double x = -kHall + 1.0; x < kHall - 1.0; x += 0.1) {
      map.insert(look(hall, {x, side, side > 0.0 ? M_PI : 0.0}, random));
    }
  }
  map.lookBack();
  return map;
}

std::vector<MapLine> dotted(const LineMap& map) {
  std::vector<MapLine> found;
  for (const MapLine& line : map.lines()) {
    if (line.kind == LineKind::kDotted) found.push_back(line);
  }
  return found;
}

/// Share of the stretch that lies within 10 cm of one of the lines.
double foundOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
               const std::vector<MapLine>& lines) {
  SegmentWorld world;
  world.walls.push_back({from, to});
  return lines.empty() ? 0.0 : recall(world, lines, 0.1);
}

TEST(DottedWalls, RowOfPostsIsFoundFromEndToEnd) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    Hall hall = emptyHall();
    const Eigen::Vector2d from(-6.0, -0.8), to(5.0, 0.7);
    addPosts(from, to, random, &hall.solid);
    const std::vector<MapLine> found = dotted(mapOf(hall, random));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_GT(foundOf(from, to - 1.5 * (to - from).normalized(), found), 0.9);
    EXPECT_LT(found[0].share, 0.3);  // 5 cm of each 1.25 m, as wide as a beam is
    EXPECT_GT(found[0].support, 20.0);
  }
}

TEST(DottedWalls, PaneThatReturnsOneBeamInFiveIsFound) {
  std::mt19937 random(4);
  Hall hall = emptyHall();
  const Eigen::Vector2d from(-5.0, 0.5), to(4.0, -0.4);
  hall.pane.walls.push_back({from, to});
  const LineMap map = mapOf(hall, random);
  EXPECT_GT(foundOf(from, to, map.lines()), 0.9);
}

TEST(DottedWalls, ClutterGivesNone) {
  int rows = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    Hall hall = emptyHall();
    std::uniform_real_distribution<double> x(-7.0, 7.0), y(-2.0, 2.0);
    for (int k = 0; k < 40; ++k) {
      const double px = x(random), py = y(random);
      hall.solid.box(px - 0.02, py - 0.02, px + 0.02, py + 0.02);
    }
    rows += static_cast<int>(dotted(mapOf(hall, random)).size());
  }
  EXPECT_EQ(rows, 0);
}

TEST(DottedWalls, WhatALaserScattersBehindItsWallsIsNone) {
  // 5 mm and 1 % of the range: from five metres, one return in two hundred lies 15 cm off its wall.
  int rows = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    const Hall hall = emptyHall();
    LineMap map;
    for (double side = -1.0; side < 1.05; side += 0.1) {
      for (double x = -kHall + 1.0; x < kHall - 1.0; x += 0.5) {
        Scan scan = hall.solid.scan({x, side, 0.0}, 0.005, random);
        std::normal_distribution<double> noise(0.0, 0.01);
        for (double& range : scan.ranges) range *= 1.0 + noise(random);
        map.insert(scan);
      }
    }
    map.lookBack();
    rows += static_cast<int>(dotted(map).size());
  }
  EXPECT_EQ(rows, 0);
}

TEST(DottedWalls, RowThatWasCarriedAwayGoes) {
  std::mt19937 random(5);
  Hall hall = emptyHall();
  addPosts({-6.0, 0.0}, {5.0, 0.0}, random, &hall.solid);
  LineMap map;
  for (double x = -7.0; x < 7.0; x += 0.1) map.insert(look(hall, {x, -2.5, 0.0}, random));
  const Hall cleared = emptyHall();
  for (int round = 0; round < 4; ++round) {
    for (double x = -7.0; x < 7.0; x += 0.1) {
      map.insert(look(cleared, {x, 1.2 + 0.9 * round, 0.0}, random));
    }
  }
  map.lookBack();
  EXPECT_TRUE(dotted(map).empty());
}

TEST(DottedWalls, EmptyHallHasNone) {
  std::mt19937 random(6);
  EXPECT_TRUE(dotted(mapOf(emptyHall(), random)).empty());
}

}  // namespace
}  // namespace cca
