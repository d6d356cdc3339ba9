// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/tangent_graph.hpp"

#include <gtest/gtest.h>

#include "box_world.hpp"

namespace cca::testing {
namespace {

constexpr double kRadius = 0.3;

std::vector<TangentNode> graph(const BoxWorld& world, const Pose2& pose, double range) {
  const LocalView view = makeLocalView(world.scan(pose, range), {}, pose, 2.0 * kRadius);
  const ConfigurationSpace space{view.obstacles, kRadius - 0.02};
  const auto ranges = space.freeRanges(pose.position(), 360, range);
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
}  // namespace cca::testing
