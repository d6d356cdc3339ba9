// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/movers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "cca_mrpt/simulation/simulation.hpp"

namespace cca::movers_test {
namespace {

World room() {
  return World("room", 120, 80, std::vector<unsigned char>(120 * 80, 0), 0.05, {0.0, 0.0});
}

Mover walker(std::vector<Eigen::Vector2d> way_points, double gap) {
  Mover mover;
  mover.way_points = std::move(way_points);
  mover.body.T_map_body = {mover.way_points[0].x(), mover.way_points[0].y(), 0.0};
  mover.gap = gap;
  return mover;
}

const Eigen::Vector2d kFarAway(-100.0, -100.0);

std::string complaintAbout(const std::string& text) {
  const std::string path = testing::TempDir() + "movers_under_test.yaml";
  std::ofstream(path) << text;
  try {
    loadMovers(path, room());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Movers, WalkToTheirWayPointsAndBack) {
  Movers movers({walker({{1.0, 1.0}, {4.0, 1.0}}, 0.4)}, 1);
  double farthest = 0.0;
  for (int i = 0; i < 700; ++i) {
    movers.advance(room(), kFarAway, 0.25, 0.01);
    farthest = std::max(farthest, movers.bodies()[0].T_map_body.x);
  }
  EXPECT_NEAR(farthest, 4.0, 0.06);
  EXPECT_LT(movers.bodies()[0].T_map_body.x, 2.5);
}

TEST(Movers, WanderWithoutEverTouchingAWall) {
  std::vector<Mover> crowd(5);
  for (Mover& mover : crowd) mover.body.T_map_body = {3.0, 2.0, 0.0};
  crowd[0].body.shape = Body::Shape::kBox;
  crowd[0].body.half_size = {0.6, 0.3};
  const World world = room();
  Movers movers(crowd, 9);
  double nearest = 1.0, widest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    movers.advance(world, kFarAway, 0.25, 0.01);
    for (const Body& body : movers.bodies()) {
      const Eigen::Vector2d p = body.T_map_body.position();
      nearest = std::min(nearest, world.clearance(p, 1.0) - body.radius());
      widest = std::max(widest, (p - Eigen::Vector2d(3.0, 2.0)).norm());
    }
  }
  EXPECT_GE(nearest, 0.0);
  EXPECT_GT(widest, 1.5);
}

// Whoever of a crowd, blind to the robot or not, moves, stays outside of all others.
TEST(Movers, WanderWithoutEverComingIntoOneAnother) {
  std::vector<Mover> crowd(8);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    crowd[i].body.T_map_body = {1.0 + static_cast<double>(i % 4), i < 4 ? 1.0 : 2.5, 0.0};
    crowd[i].gap = i % 2 ? 0.4 : 0.0;
  }
  crowd[0].body.shape = Body::Shape::kBox;
  crowd[0].body.half_size = {0.3, 0.2};
  const World world = room();
  Movers movers(crowd, 9);
  double nearest = 1.0;
  for (int step = 0; step < 10000; ++step) {
    movers.advance(world, kFarAway, 0.25, 0.01);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const Body &a = movers.bodies()[i], &b = movers.bodies()[k];
        const double apart = (a.T_map_body.position() - b.T_map_body.position()).norm();
        nearest = std::min(nearest, apart - a.radius() - b.radius());
      }
    }
  }
  EXPECT_GE(nearest, 0.0);
  EXPECT_LT(nearest, 0.02);  // they do meet
}

TEST(Movers, ThatMeetFaceToFaceTurnRound) {
  Movers movers({walker({{1.0, 1.0}, {5.0, 1.0}}, 0.4), walker({{5.0, 1.0}, {1.0, 1.0}}, 0.4)}, 1);
  // (4 - 0.5) / 1.6 = 2.19 s until they meet, then 0.81 s back at 0.8 m/s.
  for (int i = 0; i < 300; ++i) movers.advance(room(), kFarAway, 0.25, 0.01);
  EXPECT_NEAR(movers.bodies()[0].T_map_body.x, 2.75 - 0.65, 0.03);
  EXPECT_NEAR(movers.bodies()[1].T_map_body.x, 3.25 + 0.65, 0.03);
}

TEST(Movers, ThatBeginInOnePlacePart) {
  std::vector<Mover> crowd(2);
  for (Mover& mover : crowd) mover.body.T_map_body = {3.0, 2.0, 0.0};
  Movers movers(crowd, 9);
  double farthest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    movers.advance(room(), kFarAway, 0.25, 0.01);
    const auto& bodies = movers.bodies();
    farthest = std::max(farthest,
                        (bodies[0].T_map_body.position() - bodies[1].T_map_body.position()).norm());
  }
  EXPECT_GT(farthest, 0.5);
}

TEST(Movers, StopBeforeARobotThatStandsInTheirWay) {
  Simulation simulation(room(), {3.0, 1.0, 0.0}, {}, {walker({{1.0, 1.0}, {5.0, 1.0}}, 0.4)});
  simulation.drive({}, 10.0);
  EXPECT_EQ(simulation.moverContacts(), 0);
  EXPECT_EQ(simulation.collisions(), 0);
  EXPECT_LE(simulation.bodies()[0].T_map_body.x, 3.0 - 0.25 - 0.25 - 0.4 + 1e-9);
}

TEST(Movers, ThatDriveIntoAStandingRobotAreNotTheRobotsCollision) {
  Simulation simulation(room(), {3.0, 1.0, 0.0}, {}, {walker({{1.0, 1.0}, {5.0, 1.0}}, 0.0)});
  simulation.drive({}, 3.0);
  EXPECT_EQ(simulation.moverContacts(), 1);
  EXPECT_EQ(simulation.collisions(), 0);
  EXPECT_LE(simulation.bodies()[0].T_map_body.x, 2.5);
}

TEST(Movers, StopARobotThatDrivesIntoThem) {
  Mover parked = walker({{3.0, 1.0}, {3.1, 1.0}}, 3.0);
  Simulation simulation(room(), {1.0, 1.0, 0.0}, {}, {parked});
  simulation.drive({0.7, 0.0}, 1.5);
  simulation.drive({0.7, 0.0}, 4.0);
  EXPECT_EQ(simulation.collisions(), 1);
  EXPECT_EQ(simulation.moverContacts(), 0);
}

TEST(Movers, AreSeenByTheLaser) {
  SimulationParameters parameters;
  parameters.laser.range_noise = 0.0;
  parameters.laser.beams = 1;
  Simulation simulation(room(), {1.0, 1.0, 0.0}, parameters,
                        {walker({{3.0, 1.0}, {3.0, 2.0}}, 0.4)});
  EXPECT_NEAR(simulation.observe().scan.ranges[0], 3.0 - 0.25 - 1.0, 1e-12);
}

TEST(MoversFile, IsReadWithItsDefaults) {
  const std::string path = testing::TempDir() + "movers.yaml";
  std::ofstream(path) << "movers:\n  - {way_points: [[1, 1], [2, 1]], loop: true}\n"
                         "  - {shape: box, size: [0.6, 0.4], speed: 0.5, start: [3, 2]}\n";
  const auto movers = loadMovers(path, room());
  ASSERT_EQ(movers.size(), 2u);
  EXPECT_TRUE(movers[0].loop);
  EXPECT_EQ(movers[0].way_points[1], Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(movers[1].body.half_size, Eigen::Vector2d(0.3, 0.2));
  EXPECT_TRUE(movers[1].way_points.empty());
}

TEST(MoversFile, ErrorsNameTheMoverTheKeyAndWhatIsAllowed) {
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(complaintAbout(text).find(part), std::string::npos) << complaintAbout(text);
  };
  expect("walkers: []\n", "walkers: is no known key");
  expect("movers:\n  - {start: [1, 1], speed: 99}\n", "movers[0]: speed: 99 is out of range");
  expect("movers:\n  - {start: [1, 1]}\n  - {start: [1]}\n",
         "movers[1]: start: must be a list of 2");
  expect("movers:\n  - {start: [0.1, 1]}\n", "comes into a wall at 0.10, 1.00 m");
  expect("movers:\n  - {way_points: [[1, 1], [9, 1]]}\n", "way_points: comes into a wall");
  expect("movers:\n  - {start: [1, 1], colour: red}\n", "colour: is no known key");
  expect("movers:\n  - {size: [1, 1], start: [1, 1]}\n", "movers[0]: size: belongs to shape: box");
  expect("movers:\n  - {shape: box, size: [1, 1], radius: 0.3, start: [1, 1]}\n",
         "movers[0]: radius: belongs to shape: disc");
  expect("movers:\n  - {start: [1, 1], loop: true}\n", "movers[0]: loop: belongs to way_points");
  expect("movers: [\n", "is not valid YAML");
  expect("movers:\n  - {start: [1, 1]\n", "is not valid YAML");
  expect("movers:\n  - {start: [1, 1]}\n\t- {start: [2, 2]}\n", "is not valid YAML");
  expect("movers:\n  - {shape: cone, start: [1, 1]}\n", "'cone' is not one of: disc, box");
}

}  // namespace
}  // namespace cca::movers_test
