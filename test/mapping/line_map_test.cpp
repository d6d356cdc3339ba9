// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "segment_world.hpp"

namespace cca {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points every 5 cm along the lines of the map.
std::vector<Eigen::Vector2d> pointsOn(const std::vector<MapLine>& lines) {
  std::vector<Eigen::Vector2d> points;
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const int n = 1 + static_cast<int>(s.length() / 0.05);
    for (int i = 0; i <= n; ++i) points.push_back(s.start + (s.end - s.start) * i / double(n));
  }
  return points;
}

/// Share of the world's wall length within `gate` of a map line.
double recall(const SegmentWorld& world, const std::vector<MapLine>& lines, double gate) {
  SegmentWorld map;
  for (const MapLine& line : lines) map.walls.push_back({line.segment.start, line.segment.end});
  int found = 0, all = 0;
  for (const SegmentWorld::Wall& wall : world.walls) {
    const int n = static_cast<int>((wall.to - wall.from).norm() / 0.05);
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d p = wall.from + (wall.to - wall.from) * ((i + 0.5) / n);
      found += !map.walls.empty() && map.distance(p) <= gate ? 1 : 0;
      ++all;
    }
  }
  return double(found) / all;
}

double precision(const SegmentWorld& world, const std::vector<MapLine>& lines, double gate) {
  int near = 0;
  const auto points = pointsOn(lines);
  for (const Eigen::Vector2d& p : points) near += world.distance(p) <= gate ? 1 : 0;
  return points.empty() ? 0.0 : double(near) / double(points.size());
}

/// Drives a circle of `radius` around (x, y) with `steps` scans.
void drive(LineMap& map, const SegmentWorld& world, std::mt19937& random, double sigma = 0.01,
           int steps = 40, double radius = 1.0, double jitter = 0.0) {
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int i = 0; i < steps; ++i) {
    const double a = 2.0 * M_PI * i / steps;
    const Pose2 pose{radius * std::cos(a), radius * std::sin(a), a};
    Scan scan = world.scan(pose, sigma, random);
    scan.T_map_sensor.x += jitter * noise(random);
    scan.T_map_sensor.y += jitter * noise(random);
    map.insert(scan);
  }
  map.finishBatch();
}

SegmentWorld room() {
  SegmentWorld world;
  world.box(-4.0, -3.0, 4.0, 3.0);
  return world;
}

TEST(LineMap, ARoomIsFourLinesThatCloseOnePolyLine) {
  LineMap map;
  std::mt19937 random(1);
  drive(map, room(), random);
  ASSERT_EQ(map.lines().size(), 4u);
  EXPECT_GT(recall(room(), map.lines(), 0.01), 0.99);
  EXPECT_GT(precision(room(), map.lines(), 0.01), 0.999);
  const std::vector<PolyLine> chains = map.polyLines();
  ASSERT_EQ(chains.size(), 1u);
  ASSERT_EQ(chains[0].vertices.size(), 5u);
  EXPECT_EQ(chains[0].vertices.front(), chains[0].vertices.back());
}

TEST(LineMap, PolyLinesHoldTheLinesAndNothingElse) {
  SegmentWorld world = room();
  world.box(2.0, 1.0, 3.0, 2.0);
  world.walls.push_back({{-3.0, -2.5}, {-2.0, -2.0}});
  LineMap map;
  std::mt19937 random(2);
  drive(map, world, random);
  const std::vector<MapLine> lines = map.lines();
  std::size_t members = 0;
  for (const PolyLine& chain : map.polyLines()) {
    ASSERT_EQ(chain.vertices.size(), chain.line_ids.size() + 1);
    for (std::size_t k = 0; k < chain.line_ids.size(); ++k, ++members) {
      const auto line = std::find_if(lines.begin(), lines.end(),
                                     [&](const MapLine& l) { return l.id == chain.line_ids[k]; });
      ASSERT_NE(line, lines.end());
      const Eigen::Vector2d &a = chain.vertices[k], &b = chain.vertices[k + 1];
      const LineSegment& s = line->segment;
      EXPECT_TRUE((s.start == a && s.end == b) || (s.start == b && s.end == a));
    }
  }
  EXPECT_EQ(members, lines.size());
}

/// A room with a niche in each side: twenty walls, all in view from the middle.
SegmentWorld roomWithNiches() {
  const std::vector<Eigen::Vector2d> quarter = {{3.0, -1.0}, {4.0, -1.0}, {4.0, 1.0}, {3.0, 1.0}};
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < 4; ++k) {
    const Pose2 turn{0.0, 0.0, k * M_PI_2};
    for (const Eigen::Vector2d& p : quarter) corners.push_back(turn * p);
    corners.push_back(turn * Eigen::Vector2d(3.0, 3.0));
  }
  SegmentWorld world;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    world.walls.push_back({corners[k], corners[(k + 1) % corners.size()]});
  }
  return world;
}

Scan reversed(Scan scan) {
  scan.angle_min = scan.bearing(scan.size() - 1);
  scan.angle_increment = -scan.angle_increment;
  std::reverse(scan.ranges.begin(), scan.ranges.end());
  return scan;
}

TEST(LineMap, WhereAScanBeginsAndWhichWayItTurnsDoesNotMatter) {
  const SegmentWorld world = roomWithNiches();
  for (const bool clockwise : {false, true}) {
    for (int heading = 0; heading < 24; ++heading) {
      LineMap map;
      std::mt19937 random(16);
      for (int i = 0; i < 4; ++i) {
        const Scan scan = world.scan({0.05 * i, 0.0, heading * M_PI / 12.0}, 0.005, random, 720);
        map.insert(clockwise ? reversed(scan) : scan);
      }
      EXPECT_GT(recall(world, map.lines(), 0.03), 0.97) << "heading " << 15 * heading;
      double support = 0.0;
      for (const MapLine& line : map.lines()) support += line.support;
      EXPECT_GT(support, 0.95 * 4 * 720) << "heading " << 15 * heading;
    }
  }
}

TEST(LineMap, LinesThatWereExtractedElsewhereMayComeInAnyOrder) {
  const SegmentWorld world = roomWithNiches();
  LineMap map;
  std::mt19937 random(17);
  for (int i = 0; i < 4; ++i) {
    const Scan scan = world.scan({0.05 * i, 0.0, 0.3}, 0.005, random, 720);
    std::vector<LineSegment> lines = extractLines(scan);
    std::shuffle(lines.begin(), lines.end(), random);
    map.insert(scan, lines);
  }
  EXPECT_GT(recall(world, map.lines(), 0.03), 0.97);
}

TEST(LineMap, TwoFacesOfAWallStayTwo) {
  SegmentWorld world = room();
  world.box(-4.0, -0.1, 2.0, 0.1);
  LineMap map;
  std::mt19937 random(3);
  for (const double y : {-1.5, 1.5}) {
    for (double x = -3.0; x < 3.0; x += 0.3) map.insert(world.scan({x, y, 0.0}, 0.01, random));
  }
  bool upper = false, lower = false;
  for (const MapLine& line : map.lines()) {
    const LineSegment& s = line.segment;
    if (s.length() < 4.0 || std::abs(s.start.y()) > 0.5 || std::abs(s.end.y()) > 0.5) continue;
    (s.start.y() > 0.0 ? upper : lower) = true;
    EXPECT_NEAR(std::abs(s.start.y()), 0.1, 0.02);
    EXPECT_NEAR(std::abs(s.end.y()), 0.1, 0.02);
  }
  EXPECT_TRUE(upper);
  EXPECT_TRUE(lower);
}

TEST(LineMap, ADoorSetBackIntoItsWallIsALineOfItsOwn) {
  SegmentWorld world;
  world.box(-4.0, -3.0, 4.0, 3.0);
  world.walls.erase(world.walls.begin());
  world.walls.insert(world.walls.end(), {{{-4.0, -3.0}, {-1.0, -3.0}},
                                         {{-1.0, -3.0}, {-1.0, -3.05}},
                                         {{-1.0, -3.05}, {0.0, -3.05}},
                                         {{0.0, -3.05}, {0.0, -3.0}},
                                         {{0.0, -3.0}, {4.0, -3.0}}});
  LineMap map;
  std::mt19937 random(3);
  for (int lap = 0; lap < 2; ++lap) drive(map, world, random);
  const std::vector<MapLine> lines = map.lines();
  const auto door = std::find_if(lines.begin(), lines.end(), [](const MapLine& line) {
    return line.segment.start.y() < -3.03 && line.segment.end.y() < -3.03;
  });
  ASSERT_NE(door, lines.end());
  EXPECT_NEAR(door->segment.length(), 1.0, 0.15);
  EXPECT_GT(recall(world, lines, 0.02), 0.98);
}

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

TEST(LineMap, ARoundRoomHasNoLongChords) {
  SegmentWorld world;
  for (int i = 0; i < 360; ++i) {
    const double a = i * M_PI / 180.0, b = (i + 1) * M_PI / 180.0;
    world.walls.push_back(
        {{5.0 * std::cos(a), 5.0 * std::sin(a)}, {5.0 * std::cos(b), 5.0 * std::sin(b)}});
  }
  LineMap map;
  std::mt19937 random(7);
  drive(map, world, random);
  // A chord of n returns with sagitta s is parted where n s^2 / 24, in squared straightnesses of a
  // wall, exceeds the price of a line: for n = 19 at s = 0.157 m. The ends of its fitted line lie
  // two thirds of that off the circle.
  for (const Eigen::Vector2d& p : pointsOn(map.lines())) EXPECT_LT(world.distance(p), 0.105);
  EXPECT_GT(recall(world, map.lines(), 0.06), 0.97);
}

TEST(LineMap, LearnsThePoseErrorOfItsScans) {
  for (const double jitter : {0.01, 0.03}) {
    LineMap map;
    std::mt19937 random(8);
    drive(map, room(), random, 0.005, 400, 1.0, jitter);
    const double learned = std::sqrt(map.noise().offsetVariance());
    EXPECT_GT(learned, 0.6 * jitter);
    EXPECT_LT(learned, 1.6 * jitter);
  }
}

TEST(LineMap, DegradesSmoothlyWithRangeNoise) {
  SegmentWorld world = room();
  world.walls.push_back({{1.5, -2.0}, {1.5, -1.0}});
  world.walls.push_back({{-2.5, 1.5}, {-1.5, 1.8}});
  for (const double sigma : {0.0, 0.01, 0.03, 0.1, 0.2, 0.3}) {
    LineMap map;
    std::mt19937 random(9);
    drive(map, world, random, sigma, 120);
    const double gate = 0.03 + sigma;
    EXPECT_GT(recall(world, map.lines(), gate), sigma > 0.15 ? 0.7 : 0.9) << sigma;
    EXPECT_GT(precision(world, map.lines(), gate), sigma > 0.15 ? 0.7 : 0.95) << sigma;
  }
}

TEST(LineMap, RefusesAPoseThatIsNotFinite) {
  LineMap map;
  std::mt19937 random(10);
  drive(map, room(), random);
  const std::size_t before = map.lines().size();
  for (const Pose2& pose :
       {Pose2{kNaN, 0.0, 0.0}, Pose2{0.0, kInfinity, 0.0}, Pose2{0.0, 0.0, kNaN}}) {
    Scan scan = room().scan({}, 0.01, random);
    scan.T_map_sensor = pose;
    EXPECT_FALSE(map.insert(scan));
  }
  EXPECT_EQ(map.lines().size(), before);
}

TEST(LineMap, BadScansDoNotHarmTheMap) {
  LineMap map;
  std::mt19937 random(11);
  drive(map, room(), random);
  for (const double bad : {kNaN, -kInfinity, 0.0, -1.0, 1e300, 1e9}) {
    for (const std::size_t beams : {0u, 1u, 2u, 3u, 360u}) {
      Scan scan = room().scan({}, 0.01, random);
      scan.ranges.assign(beams, bad);
      map.insert(scan);
      scan = room().scan({}, 0.01, random);
      for (std::size_t i = 0; i < scan.size(); i += 7) scan.ranges[i] = bad;
      map.insert(scan);
    }
  }
  Scan far = room().scan({}, 0.01, random);
  far.T_map_sensor = {1e12, -1e12, 1.0};
  map.insert(far);
  for (const MapLine& line : map.lines()) {
    EXPECT_TRUE(line.segment.start.allFinite() && line.segment.end.allFinite());
    EXPECT_TRUE(line.segment.covariance.allFinite());
  }
  EXPECT_GT(recall(room(), map.lines(), 0.02), 0.99);
}

TEST(LineMap, ASensorInsideAWallDoesNoHarm) {
  LineMap map;
  std::mt19937 random(12);
  drive(map, room(), random);
  SegmentWorld world = room();
  for (int i = 0; i < 20; ++i) map.insert(world.scan({4.0, 0.1 * i, 0.0}, 0.01, random));
  EXPECT_GT(recall(world, map.lines(), 0.02), 0.99);
  EXPECT_GT(precision(world, map.lines(), 0.05), 0.99);
}

TEST(LineMap, SameScansGiveTheSameBytes) {
  std::vector<MapLine> first;
  for (int run = 0; run < 2; ++run) {
    LineMap map;
    std::mt19937 random(13);
    SegmentWorld world = room();
    world.box(2.0, 1.0, 3.0, 2.0);
    drive(map, world, random, 0.02, 60, 1.0, 0.02);
    if (run == 0) {
      first = map.lines();
      ASSERT_GE(first.size(), 6U);  // four walls, two sides of the box
      continue;
    }
    const std::vector<MapLine> again = map.lines();
    ASSERT_EQ(first.size(), again.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(first[i].id, again[i].id);
      EXPECT_EQ(first[i].segment.start, again[i].segment.start);
      EXPECT_EQ(first[i].segment.end, again[i].segment.end);
      EXPECT_EQ(first[i].support, again[i].support);
    }
  }
}

TEST(LineMap, AWorldSeenForeverNeedsNoMoreMemory) {
  LineMap map;
  std::mt19937 random(14);
  const auto size = [&map] {
    std::size_t bins = 0, cells = 0;
    for (const Wall& wall : map.walls().all()) {
      bins += static_cast<std::size_t>(wall.profile.last() - wall.profile.first());
      cells += wall.cells.size();
    }
    return map.walls().all().size() + bins + cells;
  };
  drive(map, room(), random, 0.01, 100);
  const std::size_t early = size();
  for (int lap = 0; lap < 20; ++lap) drive(map, room(), random, 0.01, 100, 1.0, 0.01);
  EXPECT_LE(size(), early + early / 2);
}

TEST(LineMap, ScansMayBeMergedInBatches) {
  CcaParameters parameters;
  parameters.scans_per_batch = 5;
  LineMap map(parameters);
  std::mt19937 random(15);
  drive(map, room(), random, 0.01, 42);
  EXPECT_GT(recall(room(), map.lines(), 0.02), 0.99);
  EXPECT_GT(precision(room(), map.lines(), 0.02), 0.99);
  EXPECT_EQ(map.lines().size(), 4u);
}

}  // namespace
}  // namespace cca
