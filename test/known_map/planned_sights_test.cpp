// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/planned_sights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "walled_plan.hpp"

namespace cca {
namespace {

constexpr double kClearance = 0.29;  // m

/// Two rooms of 4 x 4 m, and a door between them in the wall x = 4.
std::vector<PlanLine> twoRooms(double door) {
  test::PlannedWorld place;
  place.addBox(0.0, 0.0, 8.0, 4.0);
  place.addWall({4.0, 0.0}, {4.0, 1.53});
  place.addWall({4.0, 1.53 + door}, {4.0, 4.0});
  return place.plan;
}

bool anyBeyondTheDoor(const std::vector<Scan>& sights) {
  return std::any_of(sights.begin(), sights.end(),
                     [](const Scan& sight) { return sight.T_map_sensor.x > 4.5; });
}

TEST(PlannedSights, ARangeEndsAtTheFirstLine) {
  const PlanLines plan(twoRooms(0.9));
  EXPECT_NEAR(rangeInPlan(plan, {1.0, 1.0}, 0.0, 20.0), 3.0, 1e-9);
  EXPECT_NEAR(rangeInPlan(plan, {1.0, 1.0}, M_PI_4, 20.0), 3.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(rangeInPlan(plan, {1.0, 2.0}, 0.0, 20.0), 7.0, 1e-9);  // through the door
  EXPECT_TRUE(std::isinf(rangeInPlan(plan, {1.0, 2.0}, 0.0, 6.9)));
  EXPECT_TRUE(std::isinf(rangeInPlan(plan, {9.0, 2.0}, 0.0, 20.0)));
}

TEST(PlannedSights, LeadThroughADoorThatTheRobotFitsThrough) {
  EXPECT_TRUE(anyBeyondTheDoor(plannedSights(PlanLines(twoRooms(0.9)), {1.0, 1.0}, kClearance)));
  EXPECT_FALSE(anyBeyondTheDoor(plannedSights(PlanLines(twoRooms(0.5)), {1.0, 1.0}, kClearance)));
}

TEST(PlannedSights, SeeTheWholeRoomAndNothingThroughItsWalls) {
  const PlanLines plan(twoRooms(0.5));
  const std::vector<Scan> sights = plannedSights(plan, {1.0, 1.0}, kClearance);
  EXPECT_GE(sights.size(), 4U);
  EXPECT_LE(sights.size(), 20U);
  for (const Scan& sight : sights) {
    EXPECT_LT(sight.T_map_sensor.x, 4.0);
    for (std::size_t beam = 0; beam < sight.size(); ++beam) {
      const double bearing = sight.bearing(beam);
      const Eigen::Vector2d end =
          sight.T_map_sensor.position() +
          sight.ranges[beam] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
      EXPECT_GE(plan.nearest(end, Eigen::Vector2d::Zero(), 0.001), 0);
    }
  }
}

TEST(PlannedSights, OfNoPlanAndFromOutsideThereIsLittle) {
  EXPECT_TRUE(plannedSights(PlanLines(), {0.0, 0.0}, kClearance).empty());
  const std::vector<Scan> outside =
      plannedSights(PlanLines(twoRooms(0.9)), {20.0, 0.0}, kClearance);
  EXPECT_EQ(outside.size(), 1U);
}

}  // namespace
}  // namespace cca
