// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/session/exploration_session.hpp"
#include "cca_mrpt/simulation/building.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "cca_mrpt/simulation/world_generator.hpp"

namespace cca {
namespace {

struct Result {
  bool finished = false;
  std::string reason;
  double coverage = 0.0, distance = 0.0, time = 0.0;
  int collisions = 0, mover_contacts = 0;
  std::vector<MapLine> lines;
  std::vector<TimedPose> trajectory;
};

World shipped(const std::string& name) {
  return loadWorld(std::string(CCA_MAPS_FOLDER) + "/" + name + ".yaml");
}

/// The loop of `cca-mrpt explore`, without its files.
Result explore(const World& world, const Pose2& start, int seed, double longest_time,
               const std::vector<Mover>& movers = {}, SimulationParameters simulated = {}) {
  const Parameters parameters;
  simulated.seed = static_cast<std::uint64_t>(seed);
  Simulation simulation(world, start, simulated, movers);
  ExplorationSession session(std::make_unique<GivenPoses>(),
                             {parameters.mapping, parameters.robot, parameters.exploration});
  Coverage coverage(simulation.world(), start.position(), simulated.robot.radius,
                    simulated.laser.range);
  Result result;
  while (!result.finished && simulation.time() < longest_time) {
    const Observation seen = simulation.observe();
    const Measurement measurement = measurementOf(seen, simulation.T_odom_robot());
    const Action action = session.decide(session.sense(measurement, seen.velocity));
    coverage.look(simulation.T_map_robot());
    result.finished = action.status == ExplorationStatus::kFinished;
    result.reason = action.reason;
    if (!result.finished) simulation.drive(action.velocity, parameters.run.control_period);
  }
  result.coverage = coverage.curve().back();
  result.distance = simulation.distance();
  result.time = simulation.time();
  result.collisions = simulation.collisions();
  result.mover_contacts = simulation.moverContacts();
  result.lines = session.mapping().lineMap().lines();
  result.trajectory = simulation.trajectory();
  return result;
}

/// s, without a move or a turn.
double longestStandstill(const std::vector<TimedPose>& trajectory) {
  double longest = 0.0, since = 0.0;
  Pose2 last;
  for (const TimedPose& pose : trajectory) {
    const Pose2& T = pose.T_map_robot;
    const double moved = (T.position() - last.position()).norm();
    if (moved > 1e-3 || std::abs(wrapAngle(T.theta - last.theta)) > 1e-3) {
      last = T;
      since = pose.time;
    }
    longest = std::max(longest, pose.time - since);
  }
  return longest;
}

/// Two rooms, and a passage of 1.5 m length between them.
World roomsWithAPassage(double passage) {
  Building plan;
  plan.name = "passage";
  plan.width = 8.0;
  plan.height = 5.0;
  plan.addOuterWalls(0.1);
  plan.addBox({3.4, 0.0}, {4.9, 2.25});
  plan.addBox({3.4, 2.25 + passage}, {4.9, 5.0});
  return rasterise(plan, 0.05);
}

// Five centimetres of room on each side, and one of noise. A straight way through takes ten
// seconds; a minute is for hesitating.
TEST(NarrowPassages, AreDrivenThroughWithoutHesitation) {
  for (int seed = 1; seed <= 6; ++seed) {
    const Result result =
        explore(roomsWithAPassage(0.6), {1.0 + 0.25 * seed, 4.0, 0.0}, seed, 60.0);
    EXPECT_TRUE(result.finished) << seed;
    EXPECT_GE(result.coverage, 0.99) << seed;
    EXPECT_EQ(result.collisions, 0) << seed;
  }
}

// As near to both walls as it may stand: noise shuts all cells around the robot, but for single
// ones.
TEST(Corners, AreLeft) {
  for (int seed = 1; seed <= 4; ++seed) {
    const Result maze = explore(shipped("maze"), {0.37, 0.37, 0.0}, seed, 900.0);
    EXPECT_GE(maze.coverage, 0.99) << seed << ": " << maze.reason;
    EXPECT_EQ(maze.collisions, 0);
    const Result rooms = explore(shipped("two_rooms"), {0.47, 0.46, 0.0}, seed, 300.0);
    EXPECT_GE(rooms.coverage, 0.99) << seed << ": " << rooms.reason;
    EXPECT_EQ(rooms.collisions, 0);
  }
}

// Much of these can only be looked into, from a few places; which, the noise decides.
TEST(CrowdedPlaces, AreLookedIntoFromWhereverTheRobotCanGo) {
  constexpr int kWorlds = 15;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= kWorlds; ++seed) {
    const World world = rasterise(generateBuilding("crowded", seed), 0.05);
    const Result result = explore(world, *world.start, 1, 900.0);
    EXPECT_TRUE(result.finished) << seed;
    EXPECT_EQ(result.collisions, 0) << seed;
    EXPECT_GE(result.coverage, 0.93) << seed;
    sum += result.coverage;
  }
  EXPECT_GE(sum / kWorlds, 0.99);
}

// What was not worth its way may seem to be, once the ways between what is left are known better: a
// robot that is still asking what is left must not go there by what it knew before. It stood for
// hours at a place that it had seen.
TEST(NoisyPlaces, EndWithoutALongStandstill) {
  SimulationParameters simulated;
  simulated.laser.range = 20.0;
  simulated.laser.range_noise = 0.03;
  simulated.laser.angle_noise_deg = 0.5;
  simulated.laser.dropout = 0.01;
  const World world = rasterise(generateBuilding("apartment", 2), 0.05);
  const Result result = explore(world, *world.start, 1, 1200.0, {}, simulated);
  EXPECT_TRUE(result.finished);
  EXPECT_GE(result.coverage, 0.995);
  EXPECT_LT(longestStandstill(result.trajectory), 60.0);
  EXPECT_EQ(result.collisions, 0);
}

struct Case {
  const char* world;
  Pose2 start;
  int seed;
  /// s, simulated: five times what a robot of 0.7 m/s took when this was written. Ends hangs.
  double longest_time;
};

class Worlds : public testing::TestWithParam<Case> {};

TEST_P(Worlds, AreSeenToNinetyNinePercentWithoutACollision) {
  const auto& [name, start, seed, longest_time] = GetParam();
  const World world = shipped(name);
  const Result result = explore(world, start, seed, longest_time);
  EXPECT_TRUE(result.finished) << "after " << result.distance << " m";
  EXPECT_GE(result.coverage, 0.99) << result.reason;
  EXPECT_EQ(result.collisions, 0);
  double nearest = 1.0;
  for (const TimedPose& pose : result.trajectory) {
    nearest = std::min(nearest, world.clearance(pose.T_map_robot.position(), 1.0));
  }
  EXPECT_GE(nearest, 0.25 - 1e-6);
  EXPECT_LT(longestStandstill(result.trajectory), 10.0);
  EXPECT_GT(result.lines.size(), 4u);
}

INSTANTIATE_TEST_SUITE_P(Small, Worlds,
                         testing::Values(Case{"two_rooms", {2.0, 3.0, 0.0}, 1, 200.0},
                                         Case{"two_rooms", {9.18, 5.08, 1.57}, 2, 200.0},
                                         Case{"corridor_loop", {1.2, 1.2, 0.0}, 1, 600.0},
                                         Case{"corridor_loop", {7.22, 15.18, -2.36}, 2, 600.0},
                                         Case{"maze", {1.0, 1.0, 0.0}, 1, 1500.0},
                                         Case{"gallery", {2.0, 8.0, 0.0}, 3, 1500.0},
                                         Case{"random", {3.475, 2.025, 0.0}, 1, 1500.0}),
                         [](const auto& one) {
                           return std::string(one.param.world) + "_" + std::to_string(one.index);
                         });

TEST(Exploration, OfEqualSeedsIsEqualToTheLastBit) {
  const World world = shipped("two_rooms");
  const Result a = explore(world, *world.start, 5, 200.0);
  const Result b = explore(world, *world.start, 5, 200.0);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.time, b.time);
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i) {
    EXPECT_EQ(a.lines[i].segment.start, b.lines[i].segment.start);
    EXPECT_EQ(a.lines[i].segment.end, b.lines[i].segment.end);
  }
}

TEST(Exploration, AmongMoversEndsWithoutTheRobotsCollision) {
  const World world = shipped("corridor_loop");
  const auto movers =
      loadMovers(std::string(CCA_MAPS_FOLDER) + "/corridor_loop.movers.yaml", world);
  const Result result = explore(world, *world.start, 1, 1500.0, movers);
  EXPECT_TRUE(result.finished);
  EXPECT_GE(result.coverage, 0.99);
  EXPECT_EQ(result.collisions, 0);
}

}  // namespace
}  // namespace cca
