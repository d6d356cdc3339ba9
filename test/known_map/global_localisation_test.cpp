// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/global_localisation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "walled_plan.hpp"

namespace cca {
namespace {

using test::PlannedWorld;

const LocalisationEffort kAllAtOnce{std::numeric_limits<int>::max(),
                                    std::numeric_limits<int>::max()};

std::optional<PoseBelief> foundAt(PlannedWorld& place, const PlanLines& plan, const Pose2& pose) {
  GlobalLocalisation localisation(plan);
  localisation.begin();
  return localisation.add(scanSurface(place.world.scan(pose, 360, 2.0 * M_PI, 0.01)), {}, {},
                          kAllAtOnce);
}

TEST(GlobalLocalisation, OneScanOfARoomUnlikeItsTurnsIsEnough) {
  PlannedWorld room = test::roomWithNiche();
  const PlanLines plan(room.plan);
  for (const Pose2& truth : {Pose2{2.5, 2.0, 0.7}, Pose2{5.5, 4.0, -2.4}, Pose2{1.0, 4.0, 3.0}}) {
    const auto found = foundAt(room, plan, truth);
    ASSERT_TRUE(found);
    EXPECT_LT((found->mean.position() - truth.position()).norm(), 0.03);
    EXPECT_NEAR(wrapAngle(found->mean.theta - truth.theta), 0.0, 0.01);
  }
}

TEST(GlobalLocalisation, FurnitureThatThePlanDoesNotShowIsBorne) {
  PlannedWorld room = test::roomWithNiche();
  room.world.addBox(3.4, 0.3, 4.4, 1.3);
  room.world.addBox(6.5, 1.0, 7.5, 2.2);
  room.world.addBox(0.2, 3.8, 1.1, 4.8);
  const PlanLines plan(room.plan);
  const Pose2 truth{2.5, 2.0, 0.7};
  const auto found = foundAt(room, plan, truth);
  ASSERT_TRUE(found);
  EXPECT_LT((found->mean.position() - truth.position()).norm(), 0.05);
}

TEST(GlobalLocalisation, ARoomThatIsItsOwnTurnIsNeverDecided) {
  PlannedWorld room;
  room.addBox(0.0, 0.0, 7.0, 5.0);
  const PlanLines plan(room.plan);
  GlobalLocalisation localisation(plan);
  localisation.begin();
  Pose2 pose{2.0, 2.0, 0.3};
  Pose2 wheels;
  for (int k = 0; k < 12; ++k) {
    const Pose2 step{0.25, 0.0, 0.1};
    pose = pose * step;
    wheels = wheels * step;
    const auto surface = scanSurface(room.world.scan(pose, 360, 2.0 * M_PI, 0.01));
    EXPECT_FALSE(localisation.add(surface, wheels, {}, kAllAtOnce));
  }
  ASSERT_GE(localisation.hypotheses().size(), 2U);
}

/// Two rooms that are alike, but for a niche that is seen from their doors on.
PlannedWorld twoRoomsAlike() {
  PlannedWorld rooms;
  for (const double x : {0.0, 10.0}) {
    rooms.addWall({x, 0}, {x + 4, 0});
    rooms.addWall({x, 0}, {x, 7});
    rooms.addWall({x + 4, 0}, {x + 4, 7});
    rooms.addWall({x, 7}, {x + 1, 7});
    rooms.addWall({x + 2, 7}, {x + 4, 7});
  }
  rooms.addWall({4, 7}, {10, 7});
  rooms.addWall({0, 7}, {0, 9});
  rooms.addWall({14, 7}, {14, 11});
  rooms.addWall({0, 9}, {9, 9});
  rooms.addWall({9, 9}, {9, 11});
  rooms.addWall({9, 11}, {14, 11});
  return rooms;
}

TEST(GlobalLocalisation, RoomsAlikeAreToldApartByTheWay) {
  PlannedWorld rooms = twoRoomsAlike();
  const PlanLines plan(rooms.plan);
  GlobalLocalisation localisation(plan);
  localisation.begin();
  std::optional<PoseBelief> found;
  double decided_at = 0.0;
  for (double y = 1.0; y < 8.0 && !found; y += 0.3) {
    const Pose2 truth{11.5, y, M_PI_2};
    const auto surface = scanSurface(rooms.world.scan(truth, 360, 2.0 * M_PI, 0.01, 4.0));
    found = localisation.add(surface, {y, 0.0, 0.0}, {}, kAllAtOnce);
    decided_at = y;
  }
  ASSERT_TRUE(found);
  EXPECT_GT(decided_at, 4.0);
  EXPECT_NEAR(found->mean.x, 11.5, 0.1);
  EXPECT_NEAR(found->mean.y, decided_at, 0.15);
}

TEST(GlobalLocalisation, APlaceThatIsNotInThePlanIsNotFound) {
  PlannedWorld room = test::roomWithNiche();
  PlannedWorld other;
  other.addBox(0.0, 0.0, 3.0, 11.0);
  other.addBox(1.0, 3.0, 2.0, 4.0);
  const PlanLines plan(other.plan);
  EXPECT_FALSE(foundAt(room, plan, {2.5, 2.0, 0.7}));
}

TEST(GlobalLocalisation, WorkSpreadOverScansComesToTheSameEnd) {
  PlannedWorld room = test::roomWithNiche();
  const PlanLines plan(room.plan);
  const Pose2 truth{2.5, 2.0, 0.7};
  const ScanSurface surface = scanSurface(room.world.scan(truth, 360, 2.0 * M_PI, 0.01));
  GlobalLocalisation at_once(plan), in_bits(plan);
  at_once.begin();
  in_bits.begin();
  const auto found = at_once.add(surface, {}, {}, kAllAtOnce);
  ASSERT_TRUE(found);
  std::optional<PoseBelief> later;
  int scans = 0;
  for (; !later && scans < 100000; ++scans) later = in_bits.add(surface, {}, {}, {20000, 5});
  ASSERT_TRUE(later);
  EXPECT_GT(scans, 3);
  EXPECT_NEAR(later->mean.x, found->mean.x, 1e-3);
  EXPECT_NEAR(later->mean.theta, found->mean.theta, 1e-3);
}

}  // namespace
}  // namespace cca
