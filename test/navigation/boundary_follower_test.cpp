// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/boundary_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "box_world.hpp"

namespace cca::testing {
namespace {

bool always(const Eigen::Vector2d&) { return true; }

ConfigurationSpace sampled(const std::vector<Box>& boxes) {
  ConfigurationSpace space;
  space.radius = 0.3;
  for (const Box& box : boxes) {
    for (double x = box.low.x(); x < box.high.x() + 1e-9; x += 0.05) {
      space.obstacles.push_back({x, box.low.y()});
      space.obstacles.push_back({x, box.high.y()});
    }
    for (double y = box.low.y(); y < box.high.y() + 1e-9; y += 0.05) {
      space.obstacles.push_back({box.low.x(), y});
      space.obstacles.push_back({box.high.x(), y});
    }
  }
  return space;
}

TEST(BoundaryTrace, AroundOnePointIsACircle) {
  const ConfigurationSpace space{{{1, 1}}, 0.3};
  const double around = 2.0 * M_PI * 0.3;
  const auto trace = traceBoundary(space, {2, 1}, false, around, always);
  for (const BoundaryPoint& p : trace)
    EXPECT_NEAR((p.center_map - Eigen::Vector2d(1, 1)).norm(), 0.3, 1e-9);
  EXPECT_NEAR(trace.back().heading - trace.front().heading, 2.0 * M_PI, 0.36);
}

TEST(BoundaryTrace, AroundABoxHasItsPerimeterAndOneWholeTurn) {
  const ConfigurationSpace space = sampled({{{0, 0}, {2, 1}}});
  const double perimeter = 6.0 + 2.0 * M_PI * 0.3;
  for (bool on_the_right : {false, true}) {
    const auto trace = traceBoundary(space, {1.0, -0.3}, on_the_right, perimeter, always);
    EXPECT_LT((trace.back().center_map - trace.front().center_map).norm(), 0.15);
    EXPECT_NEAR(trace.back().heading - trace.front().heading, on_the_right ? -2 * M_PI : 2 * M_PI,
                0.4);
    for (const BoundaryPoint& p : trace) EXPECT_NEAR(space.clearance(p.center_map), 0.3, 1e-6);
  }
}

TEST(BoundaryTrace, InsideARoomTurnsTheOtherWay) {
  const ConfigurationSpace space = sampled({{{0, 0}, {3, 2}}});
  const double inside = 2.0 * (3.0 - 0.6) + 2.0 * (2.0 - 0.6);
  const auto trace = traceBoundary(space, {1.5, 0.3}, true, inside, always);
  EXPECT_NEAR(trace.back().heading - trace.front().heading, 2.0 * M_PI, 0.4);
  EXPECT_LT((trace.back().center_map - trace.front().center_map).norm(), 0.15);
}

TEST(BoundaryTrace, DoesNotEnterAGapThatIsTooNarrowAndEntersAWiderOne) {
  for (double gap : {0.5, 0.75}) {
    const ConfigurationSpace space = sampled({{{0, 0}, {2, 1}}, {{2 + gap, 0}, {4 + gap, 1}}});
    const auto trace = traceBoundary(space, {1.0, -0.3}, false, 2.5, always);
    const bool enters = std::any_of(trace.begin(), trace.end(),
                                    [](const BoundaryPoint& p) { return p.center_map.y() > 0.2; });
    EXPECT_EQ(enters, gap > 0.6) << gap;
  }
}

TEST(BoundaryTrace, EndsWhereItIsToldTo) {
  const ConfigurationSpace space = sampled({{{0, 0}, {2, 1}}});
  const auto trace = traceBoundary(space, {1.0, -0.3}, false, 10.0,
                                   [](const Eigen::Vector2d& p) { return p.x() < 1.5; });
  EXPECT_LT(trace.back().center_map.x(), 1.5);
  EXPECT_TRUE(traceBoundary({{}, 0.3}, {0, 0}, true, 1.0, always).empty());
}

// Walks along a circle; angle and length grow together.
void walkCircle(LoopDetector& circling, double radius, double from, double to) {
  for (double a = from; a <= to; a += 0.02) {
    circling.add({radius * std::cos(a), radius * std::sin(a)}, radius * a, a);
  }
}

TEST(LoopDetector, ClosesAfterAWholeTurnWithSomeOverlap) {
  LoopDetector circling;
  walkCircle(circling, 2.0, 0.0, 2.0 * M_PI);
  EXPECT_FALSE(circling.closed()) << "the start has only just been met";
  walkCircle(circling, 2.0, 2.0 * M_PI, 2.0 * M_PI + 0.6);
  EXPECT_TRUE(circling.closed());
}

TEST(LoopDetector, GoingBackAlongACorridorsOtherSideIsNoLoop) {
  LoopDetector circling;
  double length = 0.0;
  for (double x = 0.0; x < 10.0; x += 0.05) circling.add({x, 0.0}, length += 0.05, 0.0);
  for (double x = 10.0; x > -5.0; x -= 0.05) circling.add({x, 0.05}, length += 0.05, M_PI);
  EXPECT_FALSE(circling.closed());
}

TEST(LoopDetector, StandingStillIsNoLoop) {
  LoopDetector circling;
  for (int i = 0; i < 1000; ++i) circling.add({1.0, 1.0}, 0.0, 0.01 * i);
  EXPECT_FALSE(circling.closed());
}

TEST(LoopDetector, CrossingTheStartOnAnotherHeadingIsNoLoop) {
  LoopDetector circling;
  double length = 0.0;
  for (double x = -2.0; x < 5.0; x += 0.05) circling.add({x, 0.0}, length += 0.05, 0.0);
  for (double y = -3.0; y < 3.0; y += 0.05) circling.add({0.0, y}, length += 0.05, 1.5 * M_PI);
  EXPECT_FALSE(circling.closed());
}

TEST(LoopDetector, ForgetsOnReset) {
  LoopDetector circling;
  walkCircle(circling, 2.0, 0.0, 2.0 * M_PI + 0.6);
  circling.reset();
  EXPECT_FALSE(circling.closed());
}

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
  EXPECT_FALSE(follower.hasLooped());
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
