// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/moving_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "random_worlds.hpp"

namespace cca::testing {
namespace {

long movingBeams(const std::vector<bool>& moving) {
  return std::count(moving.begin(), moving.end(), true);
}

TEST(MovingPoints, FindsNobodyInAStillWorldWhileTheRobotDrivesAndTurns) {
  long false_alarms = 0, beams = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Query query = randomQuery(seed);
    MovingPoints points;
    Pose2 pose = query.start;
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, 0.01);
    for (int i = 0; i < 40; ++i) {
      Scan scan = query.world.scan(pose, 8.0);
      for (double& r : scan.ranges) r += isReturn(r) ? noise(generator) : 0.0;
      false_alarms += movingBeams(points.update(scan, 0.01, 0.1 * i));
      beams += static_cast<long>(scan.size());
      const Pose2 next = pose * Pose2{0.05, 0.0, 0.06};
      if (query.world.clearance(next.position()) > 0.3) pose = next;
      pose.theta = wrapAngle(pose.theta + 0.02);
    }
  }
  EXPECT_LT(false_alarms, beams / 1000);
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

TEST(MovingPoints, TakesScansWithoutBeamsOrReturns) {
  MovingPoints points;
  EXPECT_TRUE(points.update({}, 0.01, 0.0).empty());
  EXPECT_EQ(movingBeams(points.update(BoxWorld{}.scan({}, 8.0), 0.01, 0.5)), 0);
  EXPECT_EQ(movingBeams(points.update(BoxWorld{}.scan({}, 8.0), 0.01, 1.0)), 0);
}

}  // namespace
}  // namespace cca::testing
