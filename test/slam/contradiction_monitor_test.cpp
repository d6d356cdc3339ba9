// SPDX-License-Identifier: BSD-3-Clause
#include "slam/contradiction_monitor.hpp"

#include <gtest/gtest.h>

#include "walled_world.hpp"

namespace cca {
namespace {

const Pose2 kAhead{0.2, 0.0, 0.0}, kStay{};

LocalMatch agreeing(double agreement, double in_common = 200.0) {
  LocalMatch match;
  match.agreement = agreement;
  match.in_common = in_common;
  return match;
}

/// A room, from a place in it.
ScanSurface roomFrom(double x) {
  test::WalledWorld world;
  world.addBox(0.0, 0.0, 8.0, 6.0);
  return scanSurface(world.scan({x, 2.0, 0.0}, 361, 2.0 * M_PI, 0.01));
}

/// People all around, elsewhere in each scan.
ScanSurface crowd(int k) {
  test::WalledWorld world;
  for (int person = 0; person < 9; ++person) {
    const double angle = 0.7 * person + 1.9 * k, range = 1.5 + 0.4 * ((person + 2 * k) % 3);
    const double x = range * std::cos(angle), y = range * std::sin(angle);
    world.addBox(x, y, x + 0.4, y + 0.4);
  }
  return scanSurface(world.scan({}, 361, 2.0 * M_PI, 0.01));
}

TEST(ContradictionMonitor, ComparesAScanWithTheUsualAgreement) {
  ContradictionMonitor monitor;
  EXPECT_TRUE(monitor.isContradiction(agreeing(0.6), 361));
  EXPECT_FALSE(monitor.isContradiction(agreeing(0.7), 361));
  EXPECT_FALSE(monitor.isContradiction(agreeing(0.1, 20.0), 361)) << "has nothing in common";
  for (int k = 0; k < 100; ++k) monitor.learn(0.7, false, kAhead);  // a crowded hall
  EXPECT_FALSE(monitor.isContradiction(agreeing(0.6), 361));
}

TEST(ContradictionMonitor, LearnsNoContradictionFromAStay) {
  ContradictionMonitor monitor;
  for (int k = 0; k < 1000; ++k) monitor.learn(0.2, true, kStay);
  EXPECT_DOUBLE_EQ(monitor.usualAgreement(), ContradictionMonitor().usualAgreement());
}

TEST(ContradictionMonitor, TakesARobotForLostAfterAMetreOfContradictions) {
  ContradictionMonitor monitor;
  for (int k = 0; k < 4; ++k) {
    EXPECT_FALSE(monitor.isLost()) << k;
    monitor.add(kAhead, crowd(k));
  }
  EXPECT_FALSE(monitor.isLost());
  monitor.add({0.3, 0.0, 0.0}, crowd(4));
  EXPECT_TRUE(monitor.isLost());
  monitor.clear();
  EXPECT_FALSE(monitor.isLost());
}

TEST(ContradictionMonitor, TakesARobotThatTurnsAmongPeopleForLostLaterThanOneInAnotherRoom) {
  const Pose2 turn{0.0, 0.0, 0.5};
  ContradictionMonitor among_people, in_another_room;
  test::WalledWorld room;
  room.addBox(0.0, 0.0, 8.0, 6.0);
  for (int k = 0; k < 6; ++k) {
    among_people.add(turn, crowd(k));
    in_another_room.add(turn, scanSurface(room.scan({3.0, 2.0, 0.5 * k}, 361, 2.0 * M_PI, 0.01)));
  }
  EXPECT_FALSE(among_people.isLost());
  EXPECT_TRUE(in_another_room.isLost());
  for (int k = 6; k < 50; ++k) among_people.add(kStay, crowd(k));
  EXPECT_TRUE(among_people.isLost()) << "after some seconds";
}

TEST(ContradictionMonitor, IsNotEndedInAnotherRoomByAScanThatAgreesByHalf) {
  ContradictionMonitor monitor;
  EXPECT_FALSE(monitor.isContradiction(agreeing(0.7), 361));
  for (int k = 0; k < 3; ++k) monitor.add(kAhead, roomFrom(2.0 + 0.2 * k));
  EXPECT_TRUE(monitor.isContradiction(agreeing(0.7), 361));
  EXPECT_FALSE(monitor.isContradiction(agreeing(0.85), 361));
}

}  // namespace
}  // namespace cca
