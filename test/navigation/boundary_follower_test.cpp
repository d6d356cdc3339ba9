// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/boundary_follower.hpp"

#include <gtest/gtest.h>

#include "box_world.hpp"

namespace cca::testing {
namespace {

constexpr double kRadius = 0.295;

struct Sight {
  LocalView view;
  ConfigurationSpace trace, way;
};

Sight look(const BoxWorld& world, const Pose2& pose, double range = 8.0) {
  Sight sight;
  sight.view = makeLocalView(world.scan(pose, range), {}, pose, 0.6);
  sight.trace = {sight.view.obstacles, kRadius};
  sight.way = {sight.view.obstacles, 0.28};
  return sight;
}

// A box between the robot and the goal at (5, 0).
BoxWorld boxAhead() {
  BoxWorld world;
  world.add(2, -1, 3, 1);
  return world;
}

const Eigen::Vector2d kGoal(5, 0);

TEST(BoundaryFollower, HeadsForTheVisibleEndOnItsSide) {
  const Sight sight = look(boxAhead(), {0, 0, 0});
  for (bool on_the_right : {false, true}) {
    BoundaryFollower follower;
    follower.start({1.7, 0}, on_the_right, kGoal, sight.view, sight.trace);
    const auto target = follower.step(kGoal, sight.view, sight.trace, sight.way, 3.3);
    ASSERT_TRUE(target);
    EXPECT_EQ(target->y() > 0.0, on_the_right);
    EXPECT_GT(std::abs(target->y()), 0.9);
  }
}

TEST(BoundaryFollower, KeepsTheLeastDistanceToTheGoalOfWhatItHasFollowed) {
  const BoxWorld world = boxAhead();
  BoundaryFollower follower;
  Sight sight = look(world, {0, 0, 0});
  follower.start({1.7, 0}, true, kGoal, sight.view, sight.trace);
  EXPECT_NEAR(follower.followedDistance(), 3.3, 0.05);
  double before = follower.followedDistance();
  // Along the left face and the top: the boundary comes nearer to the goal.
  for (const Pose2& pose :
       {Pose2{1.7, 0.5, 1.5}, Pose2{1.75, 1.2, 0.8}, Pose2{2.3, 1.3, 0.0}, Pose2{2.8, 1.3, 0.0}}) {
    sight = look(world, pose);
    follower.step(kGoal, sight.view, sight.trace, sight.way, 3.0);
    EXPECT_LE(follower.followedDistance(), before);
    before = follower.followedDistance();
  }
  EXPECT_LT(follower.followedDistance(), 2.6);
  EXPECT_FALSE(follower.circled());
}

TEST(BoundaryFollower, WhatIsFollowedMayHideBehindACorner) {
  const BoxWorld world = boxAhead();
  BoundaryFollower follower;
  Sight sight = look(world, {1.7, 0.8, 1.5});
  follower.start({1.7, 0.8}, true, kGoal, sight.view, sight.trace);
  ASSERT_TRUE(follower.step(kGoal, sight.view, sight.trace, sight.way, 3.0));
  sight = look(world, {2.0, 1.32, 0.2});  // the left face is out of sight
  EXPECT_TRUE(follower.step(kGoal, sight.view, sight.trace, sight.way, 3.0));
}

TEST(BoundaryFollower, SaysWhereTheBoundaryHasGone) {
  Sight sight = look(boxAhead(), {0, 0, 0});
  BoundaryFollower follower;
  follower.start({1.7, 0}, true, kGoal, sight.view, sight.trace);
  sight = look(BoxWorld{}, {0, 0, 0});
  EXPECT_FALSE(follower.step(kGoal, sight.view, sight.trace, sight.way, 3.0));
}

}  // namespace
}  // namespace cca::testing
