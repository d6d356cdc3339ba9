// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/world_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

Scan scanOf(double field_of_view_deg, double heading_deg) {
  Scan scan;
  scan.ranges.assign(181, 3.0);
  scan.angle_increment = field_of_view_deg / 180.0 * M_PI / 180.0;
  scan.angle_min = -0.5 * field_of_view_deg * M_PI / 180.0;
  scan.T_map_sensor.theta = heading_deg * M_PI / 180.0;
  return scan;
}

// All views would promise what lies between 3 and 20 m.
TEST(WorldModel, DoesNotTakeOneFarReturnForTheRangeOfTheLaser) {
  WorldModel world;
  Scan scan = scanOf(360.0, 0.0);
  scan.ranges[70] = 20.0;
  world.observe(scan, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(world.laserRange(), 3.0);
  scan.ranges[71] = 19.0;
  world.observe(scan, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(world.laserRange(), 19.0);
}

TEST(ScannedPlaces, AFullTurnIsAllDirectionsAtOnce) {
  ScannedPlaces places;
  places.add({5, 5}, scanOf(360.0, 17.0));
  EXPECT_TRUE(places.contains({5, 5}));
  EXPECT_TRUE(places.contains({6, 6})) << "of the same block";
  EXPECT_FALSE(places.contains({25, 5}));
}

TEST(ScannedPlaces, HalfTurnsAddUp) {
  ScannedPlaces places;
  places.add({5, 5}, scanOf(190.0, 0.0));
  places.add({5, 5}, scanOf(190.0, 60.0));
  EXPECT_FALSE(places.contains({5, 5}));
  places.add({25, 5}, scanOf(190.0, 180.0));
  EXPECT_FALSE(places.contains({5, 5})) << "that was another place";
  places.add({5, 5}, scanOf(190.0, 180.0));
  EXPECT_TRUE(places.contains({5, 5}));
}

TEST(ScannedPlaces, ScansWithoutDirectionAddNothing) {
  ScannedPlaces places;
  places.add({5, 5}, Scan{});
  Scan odd = scanOf(190.0, 0.0);
  odd.T_map_sensor.theta = std::numeric_limits<double>::quiet_NaN();
  places.add({5, 5}, odd);
  odd = scanOf(190.0, 0.0);
  odd.angle_increment = std::numeric_limits<double>::infinity();
  places.add({5, 5}, odd);
  places.add({5, 5}, scanOf(190.0, 0.0));
  EXPECT_FALSE(places.contains({5, 5}));
  places.add({5, 5}, scanOf(190.0, 180.0));
  EXPECT_TRUE(places.contains({5, 5}));
}

TEST(WorldModel, IsMadeAnewFromTheScansOfAPastThatWasCorrected) {
  WorldModel world(0.29);
  PastScans past;
  const Pose2 T_was_robot{1.02, 0.02, 0.0}, T_map_robot{2.02, 0.02, 0.0};
  Scan scan = scanOf(360.0, 0.0);
  scan.T_map_sensor = T_was_robot;
  world.observe(scan, T_was_robot.position());
  past.add({scan, rangeNoise(scan), {}}, T_was_robot);
  past.correct({T_map_robot}, {true});
  const CellMove moved = world.correct(past);
  const auto cellOf = [&](const Pose2& pose) { return world.grid().cellOf(pose.position()); };
  EXPECT_TRUE(world.scanned().contains(cellOf(T_map_robot)));
  EXPECT_FALSE(world.scanned().contains(cellOf(T_was_robot)));
  EXPECT_EQ(moved(cellOf(T_was_robot)), cellOf(T_map_robot));
}

}  // namespace
}  // namespace cca
