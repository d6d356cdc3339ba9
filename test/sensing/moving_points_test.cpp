// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/moving_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../navigation/random_worlds.hpp"
#include "sensing/beam.hpp"

namespace cca::testing {
namespace {

long movingBeams(const std::vector<bool>& moving) {
  return std::count(moving.begin(), moving.end(), true);
}

/// A robot that drives and turns where it has room, and whose ranges have 1 cm of noise.
class NoisyDrive {
 public:
  NoisyDrive(const Query& query, unsigned seed)
      : room_(query.world), T_map_robot_(query.start), generator_(seed) {}

  Scan scan(const BoxWorld& world) {
    Scan scan = world.scan(T_map_robot_, 8.0);
    for (double& r : scan.ranges) r += isReturn(r) ? noise_(generator_) : 0.0;
    return scan;
  }

  void move(double step) {
    const Pose2 next = T_map_robot_ * Pose2{step, 0.0, 0.06};
    if (room_.clearance(next.position()) > 0.3) T_map_robot_ = next;
    T_map_robot_.theta = wrapAngle(T_map_robot_.theta + 0.02);
  }

 private:
  BoxWorld room_;
  Pose2 T_map_robot_;
  std::mt19937 generator_;
  std::normal_distribution<double> noise_{0.0, 0.01};
};

TEST(MovingPoints, FindsNobodyInAStillWorldWhileTheRobotDrivesAndTurns) {
  long false_alarms = 0, beams = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Query query = randomQuery(seed);
    MovingPoints points;
    NoisyDrive robot(query, seed);
    for (int i = 0; i < 40; ++i) {
      const Scan scan = robot.scan(query.world);
      false_alarms += movingBeams(points.update(scan, 0.01, 0.1 * i));
      beams += static_cast<long>(scan.size());
      robot.move(0.05);
    }
  }
  EXPECT_LT(false_alarms, beams / 1000);
}

// As line SLAM's do. Beams are 1 degree apart: a centimetre at 35 cm is 1.6 of them.
TEST(MovingPoints, ATableLegBesideTheRobotStandsThoughThePosesErrByACentimetre) {
  std::mt19937 generator(4);
  std::normal_distribution<double> error(0.0, 0.007);
  long found = 0;
  for (int drive = 0; drive < 20; ++drive) {
    BoxWorld world;
    world.addFrame(10, 10);
    world.discs = {{{5.2, 5.3}, 0.02}, {{5.6, 4.7}, 0.02}};
    MovingPoints points;
    for (int i = 0; i < 20; ++i) {
      const Pose2 T_map_robot{4.8 + 0.04 * i, 5.0, 0.02 * i};
      Scan scan = world.scan(T_map_robot, 8.0);
      scan.T_map_sensor.x += error(generator);
      scan.T_map_sensor.y += error(generator);
      found += movingBeams(points.update(scan, 0.01, 0.18 * i));
    }
  }
  EXPECT_EQ(found, 0);
}

TEST(MovingPoints, AScanThatIsOffOnceIsNoSignOfPeople) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.discs = {{{6.0, 5.0}, 0.2}};
  MovingPoints points;
  for (int i = 0; i < 9; ++i) points.update(world.scan({5, 5, 0}, 8.0), 0.01, 0.1 * i);
  Scan off = world.scan({5, 5, 0}, 8.0);
  off.T_map_sensor.theta += 0.2;
  EXPECT_GT(movingBeams(points.update(off, 0.01, 0.9)), 0);
  EXPECT_FALSE(points.areAround(0.9));
}

struct Walk {
  Eigen::Vector2d from, velocity;
};

class MovingPointsWalk : public ::testing::TestWithParam<Walk> {};

TEST_P(MovingPointsWalk, FindsAWalkerWithinHalfASecond) {
  BoxWorld world;
  world.addFrame(10, 10);
  MovingPoints points;
  std::vector<bool> moving;
  Scan scan;
  for (int i = 0; i <= 6; ++i) {
    world.discs = {{GetParam().from + GetParam().velocity * 0.1 * i, 0.25}};
    scan = world.scan({5, 5, 0}, 8.0);
    moving = points.update(scan, 0.01, 0.1 * i);
  }
  long on_walker = 0, found = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector2d p =
        scan.T_map_sensor * Eigen::Vector2d(scan.ranges[i] * std::cos(scan.bearing(i)),
                                            scan.ranges[i] * std::sin(scan.bearing(i)));
    if (world.discs[0].distance(p) > 0.01) continue;
    ++on_walker;
    found += moving[i];
  }
  EXPECT_GT(on_walker, 3);
  EXPECT_EQ(found, on_walker);
  EXPECT_TRUE(points.areAround(0.6));
}

INSTANTIATE_TEST_SUITE_P(Directions, MovingPointsWalk,
                         ::testing::Values(Walk{{8, 5}, {-1, 0}}, Walk{{7, 5}, {1, 0}},
                                           Walk{{7, 4.5}, {0, 1}}, Walk{{3, 3}, {0.4, 0.4}}));

// Half a second is too short for that: a walker of 0.3 m/s has come by 13 cm, and noise is 4 cm.
TEST(MovingPoints, FindsWhoComesSlowlyStraightTowardsIt) {
  BoxWorld world;
  world.addFrame(10, 10);
  MovingPoints points;
  long found = 0;
  for (int i = 0; i <= 14; ++i) {
    world.discs = {{{7.0 - 0.025 * i, 5.0}, 0.25}};
    found = movingBeams(points.update(world.scan({5, 5, 0}, 8.0), 0.01, 0.1 * i));
  }
  EXPECT_GT(found, 3);
}

/// Returns of the scan on a disc: all of them, and those found to move or not to stand for certain.
struct OnDisc {
  int all = 0, heeded = 0;
};

OnDisc returnsOn(const Disc& disc, const Scan& scan, const std::vector<bool>& moving,
                 const std::vector<Eigen::Vector2d>& unsettled) {
  OnDisc count;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!isReturn(scan.ranges[i])) continue;
    const Eigen::Vector2d p =
        scan.T_map_sensor * Eigen::Vector2d(scan.ranges[i] * std::cos(scan.bearing(i)),
                                            scan.ranges[i] * std::sin(scan.bearing(i)));
    if (disc.distance(p) > 0.001) continue;
    ++count.all;
    count.heeded += moving[i] || std::any_of(unsettled.begin(), unsettled.end(),
                                             [&](auto& u) { return (u - p).norm() < 0.001; });
  }
  return count;
}

/// A second walker, 3.5 m off: the scans show that movers are around.
Disc passerBy(int step) { return {{8.0, 3.5 + 0.08 * step}, 0.25}; }

TEST(MovingPoints, WhatComesFromBehindSomethingIsUnsettledAtOnce) {
  MovingPoints points;
  for (int i = 0; i < 30; ++i) {
    const Disc walker{{6.2, 6.2 - 0.06 * i}, 0.2};  // behind the screen until i = 12
    BoxWorld world;
    world.addFrame(10, 10);
    world.add(5.7, 5.3, 5.8, 7.0);
    world.discs = {walker, passerBy(i)};
    const Scan scan = world.scan({5, 5, 0}, 8.0);
    const std::vector<bool> moving = points.update(scan, 0.0, 0.1 * i);
    const OnDisc on = returnsOn(walker, scan, moving, points.unsettled());
    if (i > 12 && i < 25) {
      ASSERT_GT(on.all, 3) << i;
      ASSERT_EQ(on.heeded, on.all) << i;
    }
  }
}

// People pause for two seconds and set off again, and so do the movers of the simulation: a robot
// that trusts them at that very moment is driven into.
TEST(MovingPoints, SomebodyWhoPausesForTwoSecondsIsHeededWhenSettingOffAgain) {
  MovingPoints points;
  for (int i = 0; i < 40; ++i) {
    const Disc walker{{6.5, 5.0 - 0.05 * std::min(i, 12)}, 0.2};  // comes to a stand at i = 12
    BoxWorld world;
    world.addFrame(10, 10);
    world.discs = {walker};
    const Scan scan = world.scan({5, 5, 0}, 8.0);
    const std::vector<bool> moving = points.update(scan, 0.0, 0.1 * i);
    const OnDisc on = returnsOn(walker, scan, moving, points.unsettled());
    if (i >= 12 && i <= 12 + 25) {
      ASSERT_EQ(on.heeded, on.all) << i;
    }
  }
}

TEST(MovingPoints, SomebodySlowDoesNotPassForStanding) {
  MovingPoints points;
  for (int i = 0; i < 30; ++i) {
    const Disc walker{{6.6 - 0.02 * i, 5.0}, 0.2};  // 0.2 m/s
    BoxWorld world;
    world.addFrame(10, 10);
    world.discs = {walker, passerBy(i)};
    const Scan scan = world.scan({5, 5, 0}, 8.0);
    const std::vector<bool> moving = points.update(scan, 0.0, 0.1 * i);
    if (i < 10) continue;
    const OnDisc on = returnsOn(walker, scan, moving, points.unsettled());
    ASSERT_GT(on.all, 10) << i;
    ASSERT_GE(on.heeded, 0.9 * on.all) << i;  // at its rims a slow disc looks as if it stood
  }
}

TEST(MovingPoints, WhatStandsIsSettledForARobotThatDrivesAndTurns) {
  long unsettled = 0, near = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Query query = randomQuery(seed);
    MovingPoints points;
    NoisyDrive robot(query, seed);
    for (int i = 0; i < 60; ++i) {
      BoxWorld world = query.world;
      // Somebody who comes and goes on the spot, 2.5 m before the robot.
      const Eigen::Vector2d there = query.start.position() + Eigen::Vector2d(2.5, 0.0);
      if (i % 10 < 5) world.discs.push_back({there, 0.25});
      const Scan scan = robot.scan(world);
      points.update(scan, 0.01, 0.1 * i);
      if (points.areAround(0.1 * i)) {
        unsettled += static_cast<long>(points.unsettled().size());
        near += std::count_if(scan.ranges.begin(), scan.ranges.end(),
                              [](double r) { return isReturn(r) && r < 2.0; });
      }
      robot.move(0.04);
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_LT(unsettled, near / 50);
}

/// A hall with a box near its middle, and somebody who walks past it.
/// @param aside  m, of the box: 0 stands on the lines of a grid of 5 cm.
BoxWorld hallWithBox(const Disc& walker, double aside = 0.0) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(5.5 + aside, 5.5 + aside, 5.9 + aside, 5.9 + aside);
  world.discs = {walker};
  return world;
}

long returnsOnBox(const Scan& scan) {
  long on_box = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector2d p = returnOf(scan, i);
    on_box += isReturn(scan.ranges[i]) && (p - Eigen::Vector2d(5.7, 5.7)).norm() < 0.3;
  }
  return on_box;
}

// A robot that waits for all that people pass by waits beside every wall.
TEST(MovingPoints, WhatSomebodyWalksPastStandsAsBefore) {
  MovingPoints points;
  for (int i = 0; i < 100; ++i) {
    const Disc walker{{5.2, 9.0 - 0.05 * i}, 0.2};  // at 5.7, half a metre beside it, when i = 66
    const Scan scan = hallWithBox(walker).scan({5, 4, 0}, 8.0);
    const std::vector<bool> moving = points.update(scan, 0.0, 0.1 * i);
    const OnDisc on = returnsOn(walker, scan, moving, points.unsettled());
    const Scan rest = points.withoutMovers(scan);
    if (i < 55) continue;  // nobody knows yet that the box stands
    ASSERT_EQ(on.heeded, on.all) << i;
    ASSERT_EQ(movingBeams(moving), on.all) << i;
    ASSERT_EQ(returnsOnBox(rest), returnsOnBox(scan)) << i;
    ASSERT_EQ(std::count_if(rest.ranges.begin(), rest.ranges.end(), isReturn) + on.all,
              std::count_if(scan.ranges.begin(), scan.ranges.end(), isReturn))
        << i;
  }
}

// As real lasers see it: noise of a centimetre, beams that are lost, walls anywhere in their cells.
TEST(MovingPoints, WhatSomebodyWalksPastStandsInNoiseAnywhereInItsCellsAndThoughBeamsAreLost) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::bernoulli_distribution is_lost(0.03);
  long on_box = 0, taken_for_walkers = 0, on_walker = 0, heeded = 0;
  for (const double aside : {0.0, 0.013, 0.025, 0.041}) {
    MovingPoints points;
    for (int i = 0; i < 100; ++i) {
      const Disc walker{{5.2, 9.0 - 0.05 * i}, 0.2};
      const Scan exact = hallWithBox(walker, aside).scan({5, 4, 0}, 8.0);
      Scan scan = exact;
      for (double& r : scan.ranges) r = is_lost(generator) ? INFINITY : r + noise(generator);
      const std::vector<bool> moving = points.update(scan, 0.01, 0.1 * i);
      if (i < 55) continue;
      for (std::size_t k = 0; k < scan.size(); ++k) {
        if (!isReturn(exact.ranges[k]) || !isReturn(scan.ranges[k])) continue;
        const Eigen::Vector2d p = returnOf(exact, k), seen = returnOf(scan, k);
        const bool is_box = (p - Eigen::Vector2d(5.7 + aside, 5.7 + aside)).norm() < 0.3;
        const bool is_walker = walker.distance(p) < 0.001;
        const auto& news = points.unsettled();
        const bool is_heeded = moving[k] || std::find(news.begin(), news.end(), seen) != news.end();
        on_box += is_box;
        taken_for_walkers += is_box && is_heeded;
        on_walker += is_walker;
        heeded += is_walker && is_heeded;
      }
    }
  }
  EXPECT_GT(on_box, 1000);
  EXPECT_LT(taken_for_walkers, on_box / 50);
  EXPECT_GT(heeded, 0.95 * on_walker);
}

// A narrow laser that turned away for a while, then back.
TEST(MovingPoints, WhatStoodBeforeTheRobotLookedAwayIsSettledAtOnce) {
  MovingPoints points;
  long near = 0;
  for (int i = 0; i < 120; ++i) {
    const bool looks_away = i > 80 && i < 100;
    const Disc walker{{5.0 + 0.05 * (i % 20), 1.5}, 0.2};
    Scan scan = hallWithBox(walker).scan({5, 5, 0}, 8.0);
    for (std::size_t k = 0; looks_away && k < scan.size(); ++k) {
      if (std::abs(wrapAngle(scan.bearing(k) - 0.25 * M_PI)) < 1.0) scan.ranges[k] = NAN;
    }
    points.update(scan, 0.0, 0.1 * i);
    if (i < 100) continue;
    near += returnsOnBox(scan);
    for (const Eigen::Vector2d& p : points.unsettled())
      ASSERT_GT((p - Eigen::Vector2d(5.7, 5.7)).norm(), 0.3) << i;
  }
  EXPECT_GT(near, 100);
}

// Who takes the place of something that was carried away is not known to stand.
TEST(MovingPoints, WhatWasSeenFreeStandsNoLonger) {
  MovingPoints points;
  for (int i = 0; i < 130; ++i) {
    BoxWorld world = hallWithBox({{5.0 + 0.05 * (i % 20), 3.0}, 0.2});
    const Disc other{{6.3, 5.0}, 0.2};
    if (i < 80 || i >= 120) world.discs.push_back(other);
    const Scan scan = world.scan({5, 5, 0}, 8.0);
    const std::vector<bool> moving = points.update(scan, 0.0, 0.1 * i);
    const OnDisc on = returnsOn(other, scan, moving, points.unsettled());
    if (i > 60 && i < 80) {
      ASSERT_EQ(on.heeded, 0) << i;
    } else if (i == 120) {
      ASSERT_GT(on.all, 5);
      ASSERT_EQ(on.heeded, on.all);
    }
  }
}

TEST(MovingPoints, NothingIsUnsettledWhereNobodyHasBeenSeen) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(5.7, 5.3, 5.8, 7.0);
  MovingPoints points;
  for (int i = 0; i < 20; ++i) {
    points.update(world.scan({5.0, 4.0 + 0.04 * i, 0}, 8.0), 0.0, 0.1 * i);
    EXPECT_TRUE(points.unsettled().empty());
  }
}

TEST(MovingPoints, TakesScansWithoutBeamsOrReturns) {
  MovingPoints points;
  EXPECT_TRUE(points.update({}, 0.01, 0.0).empty());
  EXPECT_EQ(movingBeams(points.update(BoxWorld{}.scan({}, 8.0), 0.01, 0.5)), 0);
  EXPECT_EQ(movingBeams(points.update(BoxWorld{}.scan({}, 8.0), 0.01, 1.0)), 0);
}

}  // namespace
}  // namespace cca::testing
