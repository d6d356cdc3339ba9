// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mapped_world.hpp"
#include "mapping/map_noise.hpp"
#include "mapping/walls.hpp"

namespace cca {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

}  // namespace
}  // namespace cca
