// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/tangent_graph.hpp"

#include <gtest/gtest.h>

#include <random>

#include "box_world.hpp"
#include "sensing/beam.hpp"

namespace cca::testing::tangent_graph_test {
namespace {

ConfigurationSpace randomSpace(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-5.0, 5.0);
  ConfigurationSpace space;
  space.radius = 0.3;
  while (space.obstacles.size() < 60) {
    const Eigen::Vector2d p(uniform(generator), uniform(generator));
    if (p.norm() > 0.31) space.obstacles.push_back(p);
  }
  return space;
}

TEST(ConfigurationSpace, StopsARadiusBeforeAPointAhead) {
  const ConfigurationSpace space{{{2.0, 0.0}}, 0.3};
  EXPECT_NEAR(space.freeDistance({0, 0}, {1, 0}, 10.0), 1.7, 1e-12);
  EXPECT_DOUBLE_EQ(space.freeDistance({0, 0}, {-1, 0}, 10.0), 10.0);
}

TEST(ConfigurationSpace, PassesAPointAtTheTangentsBearing) {
  const ConfigurationSpace space{{{2.0, 0.0}}, 0.3};
  const double tangent = std::asin(0.3 / 2.0);
  const auto towards = [](double a) { return Eigen::Vector2d(std::cos(a), std::sin(a)); };
  EXPECT_DOUBLE_EQ(space.freeDistance({0, 0}, towards(tangent + 1e-6), 5.0), 5.0);
  EXPECT_LT(space.freeDistance({0, 0}, towards(tangent - 1e-6), 5.0), 2.0);
}

TEST(ConfigurationSpace, AllBearingsAtOnceEqualEachOneAlone) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ConfigurationSpace space = randomSpace(seed);
    const auto ranges = space.freeRanges({0, 0}, directionsAround(360, 0.0), 4.0);
    for (int k = 0; k < 360; ++k) {
      const double a = 2.0 * M_PI * k / 360;
      const double alone = space.freeDistance({0, 0}, {std::cos(a), std::sin(a)}, 4.0);
      EXPECT_NEAR(ranges[static_cast<std::size_t>(k)].distance, alone, 1e-9);
    }
  }
}

TEST(ConfigurationSpace, ARobotInContactMayLeaveAndSlideButNotGoDeeper) {
  const ConfigurationSpace space{{{0.25, 0.0}}, 0.3};
  EXPECT_DOUBLE_EQ(space.freeDistance({0, 0}, {-1, 0}, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(space.freeDistance({0, 0}, {0, 1}, 1.0), 1.0);
  EXPECT_NEAR(space.freeDistance({0, 0}, {1, 0}, 1.0), 0.01, 1e-9);
}

TEST(ConfigurationSpace, WithoutObstaclesAllIsFree) {
  const ConfigurationSpace space{{}, 0.3};
  EXPECT_TRUE(space.isFree({0, 0}, {100, 0}));
  EXPECT_TRUE(space.isFree({0, 0}, {0, 0}));
  EXPECT_TRUE(std::isinf(space.clearance({0, 0})));
}

constexpr double kRadius = 0.3;

std::vector<TangentNode> graph(const BoxWorld& world, const Pose2& pose, double range) {
  const LocalView view = makeLocalView(world.scan(pose, range), {}, pose, 2.0 * kRadius);
  const ConfigurationSpace space{view.obstacles, kRadius - 0.02};
  const auto ranges = space.freeRanges(pose.position(), directionsAround(360, 0.0), range);
  return localTangentGraph(view, space, ranges, kRadius);
}

TEST(TangentGraph, HasOneNodeBesideEachEndOfABox) {
  BoxWorld world;
  world.add(3, -1, 4, 1);
  const auto nodes = graph(world, {0, 0, 0}, 8.0);
  ASSERT_EQ(nodes.size(), 2u);
  for (const TangentNode& node : nodes) {
    // Beside the corner by the radius, on the outside; the robot has it on the inner hand.
    EXPECT_NEAR((node.p_map - node.edge_map).norm(), kRadius, 1e-9);
    EXPECT_GT(std::abs(node.p_map.y()), 1.0);
    EXPECT_EQ(node.obstacle_on_the_right, node.p_map.y() > 0.0);
    EXPECT_NEAR(std::abs(node.edge_map.y()), 1.0, 0.08);
  }
}

TEST(TangentGraph, HasNoFalseNodesAlongAWallThatTheRobotTouches) {
  BoxWorld world;
  world.add(-3, 0.301, 3, 0.4);
  for (const TangentNode& node : graph(world, {0, 0, 0}, 8.0)) {
    EXPECT_GT(std::abs(node.edge_map.x()), 2.0) << "amid the wall";
  }
}

TEST(TangentGraph, IsEmptyInTheOpenAndInAClosedRoom) {
  EXPECT_TRUE(graph(BoxWorld{}, {0, 0, 0}, 8.0).empty());
  BoxWorld room;
  room.addFrame(4, 4);
  EXPECT_TRUE(graph(room, {2, 2, 0}, 8.0).empty());
}

TEST(TangentGraph, SeesACornerThatHidesItsOwnSecondFaceOnceGrown) {
  // Both faces are in sight, but for a robot of this size the corner is in the way.
  BoxWorld world;
  world.add(-4, 0.5, 0, 2.5);
  const auto nodes = graph(world, {0.2, 0.2, 0}, 8.0);
  EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [](const TangentNode& node) {
    return !node.obstacle_on_the_right && node.p_map.y() > 0.3;
  }));
}

}  // namespace
}  // namespace cca::testing::tangent_graph_test
