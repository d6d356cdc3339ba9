// SPDX-License-Identifier: BSD-3-Clause
//
// A robot that is set down anywhere in a place that it has mapped finds itself; in another one, it
// never does.
//
// CCA_RELOCATIONS sets how many places are tried in how large a building (20 or more: the office),
// CCA_FALSE_PLACES how many scans of other buildings; docs/slam.md has the results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "cca_mrpt/slam/slam.hpp"
#include "io/maps/world_files.hpp"
#include "simulation/random.hpp"
#include "slam/key_frames.hpp"
#include "slam/loop_closer.hpp"
#include "slam/loop_closing.hpp"

namespace cca {
namespace {

constexpr double kRoom = 0.4;                     // m, around the robot where it is set down
constexpr double kNear = 0.3, kNearTurn = 0.1;    // m, rad: right
constexpr double kDrive = 3.0, kLongDrive = 6.0;  // m; the long one leads out of any room's like
constexpr double kSeen = 3.0;                     // m, from where the mapping robot has been

int setting(const char* name, int usual) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : usual;
}

Simulation robotIn(const World& world, const Pose2& start, int seed) {
  const Parameters parameters;
  SimulationParameters simulated;
  simulated.laser.range_noise = 0.01;
  simulated.seed = static_cast<std::uint64_t>(seed);
  return Simulation(world, start, simulated);
}

World map(const char* name) {
  return loadWorld(std::string(CCA_MAPS_FOLDER) + "/" + name + ".yaml");
}

/// What a robot remembers that has explored a world, its poses told.
SlamMemory memoryOf(const World& world) {
  const Parameters parameters;
  Simulation robot = robotIn(world, defaultStart(world, parameters.robot.radius), 1);
  Explorer explorer(parameters.robot, parameters.exploration);
  Slam slam(robot.T_map_robot());
  for (;;) {
    const Observation seen = robot.observe();
    slam.step(seen.scan, {}, seen.T_map_robot);
    const Action action = explorer.step(seen);
    if (action.status == ExplorationStatus::kFinished) return slam.memory();
    robot.drive(action.velocity, parameters.run.control_period);
  }
}

std::vector<Eigen::Vector2d> placesOf(const SlamMemory& memory) {
  std::vector<Eigen::Vector2d> places;
  for (int k = 0; k < memory.graph.size(); ++k) places.push_back(memory.graph.pose(k).position());
  return places;
}

/// Somewhere that has been seen.
Pose2 randomPlace(const World& world, const std::vector<Eigen::Vector2d>& seen_from,
                  Random& random) {
  for (;;) {
    const auto& from = seen_from[static_cast<std::size_t>(
        random.integer(0, static_cast<int>(seen_from.size()) - 1))];
    const Eigen::Vector2d p =
        from + Eigen::Vector2d(random.uniform(-kSeen, kSeen), random.uniform(-kSeen, kSeen));
    const double theta = random.uniform(-M_PI, M_PI);
    if (world.clearance(p, kRoom) >= kRoom) return {p.x(), p.y(), theta};
  }
}

bool isRight(const Pose2& believed, const Pose2& truth) {
  return (believed.position() - truth.position()).norm() < kNear &&
         std::abs(wrapAngle(believed.theta - truth.theta)) < kNearTurn;
}

struct Count {
  int right = 0, wrong = 0;
  void add(bool is_right) { ++(is_right ? right : wrong); }
};

TEST(Relocation, ARobotThatIsSetDownAnywhereFindsItselfWithinThreeMetres) {
  const Parameters parameters;
  const int places = setting("CCA_RELOCATIONS", 6);
  const World world = map(places >= 20 ? "office" : "apartment");
  const SlamMemory memory = memoryOf(world);
  const auto seen_from = placesOf(memory);
  Random random(7);
  Count at_once, after_driving, after_long_drive;
  for (int place = 0; place < places; ++place) {
    Simulation robot = robotIn(world, randomPlace(world, seen_from, random), place);
    Explorer explorer(parameters.robot, parameters.exploration);
    Slam slam;
    slam.remember(memory);
    Observation seen = robot.observe();
    slam.step(seen.scan, {}, robot.T_odom_robot());
    const int frame = slam.keyFrames().size() - 1;
    PlaceSearch search = PlaceSearch::anywhere(slam.keyFrames(), frame, 0);
    search.run();
    const auto verdict = search.verdict(slam.keyFrames());
    if (verdict && isCredible(*verdict)) {
      at_once.add(
          isRight(slam.keyFrames().graph.pose(verdict->candidate) * verdict->T_candidate_frame,
                  robot.T_map_robot()));
    }
    const auto drive = [&](double distance, Count* count) {
      while (!slam.isInMemory() && robot.distance() < distance) {
        const Action action = explorer.step(seen);
        if (action.status == ExplorationStatus::kFinished) break;
        robot.drive(action.velocity, parameters.run.control_period);
        seen = robot.observe();
        slam.step(seen.scan, {}, robot.T_odom_robot());
      }
      if (slam.isInMemory()) count->add(isRight(slam.trajectory().back(), robot.T_map_robot()));
    };
    drive(kDrive, &after_driving);
    drive(kLongDrive, &after_long_drive);
  }
  std::printf("%d places: one scan right %d, wrong %d", places, at_once.right, at_once.wrong);
  std::printf("; after %g m right %d, wrong %d", kDrive, after_driving.right, after_driving.wrong);
  std::printf("; after %g m right %d, wrong %d\n", kLongDrive, after_long_drive.right,
              after_long_drive.wrong);
  EXPECT_EQ(at_once.wrong, 0);
  EXPECT_EQ(after_driving.wrong, 0);
  EXPECT_EQ(after_long_drive.wrong, 0);
  EXPECT_GE(at_once.right, 0.6 * places);
  EXPECT_GE(after_driving.right, 0.95 * places - 1.0);
  EXPECT_GE(after_long_drive.right, 0.98 * places);
}

/// What a robot would have seen in the same place through a mirror.
SlamMemory mirrored(SlamMemory memory) {
  PoseGraph graph;
  for (int k = 0; k < memory.graph.size(); ++k) {
    const Pose2& pose = memory.graph.pose(k);
    graph.add({pose.x, -pose.y, -pose.theta});
    auto& ranges = memory.scans[static_cast<std::size_t>(k)].scan.ranges;
    std::reverse(ranges.begin(), ranges.end());
  }
  for (GraphEdge edge : memory.graph.edges()) {
    edge.T_from_to = {edge.T_from_to.x, -edge.T_from_to.y, -edge.T_from_to.theta};
    graph.connect(edge);
  }
  memory.graph = graph;
  return memory;
}

TEST(Relocation, NoPlaceOfAnotherBuildingOrBehindAMirrorIsTakenForOne) {
  const int wanted = setting("CCA_FALSE_PLACES", 40);
  const SlamMemory known = memoryOf(map(wanted > 100 ? "office" : "apartment"));
  std::vector<SlamMemory> others{mirrored(known)};
  for (const char* name : {"corridor_loop", "random", "maze", "pillar_hall"}) {
    if (wanted > 100 || others.size() < 2) others.push_back(memoryOf(map(name)));
  }
  int all = 0, offered = 0, believed = 0;
  for (const SlamMemory& other : others) all += other.graph.size();
  const int step = std::max(1, all / wanted);
  for (const SlamMemory& other : others) {
    Slam slam;
    slam.remember(known);
    const int first = slam.remembered();
    slam.remember(other);
    const KeyFrames& frames = slam.keyFrames();
    LoopCloser closer;
    for (int k = first; k < frames.size(); k += step) {  // a drive through it, as SLAM asks
      ++offered;
      closer.beginAnywhere(frames, k, 0);
      while (closer.isSearching()) {
        believed += !closer.advance(frames, std::numeric_limits<int>::max()).empty();
      }
    }
  }
  std::printf("%d scans of other buildings offered, %d believed\n", offered, believed);
  EXPECT_GE(offered, wanted);
  EXPECT_EQ(believed, 0);
}

}  // namespace
}  // namespace cca
