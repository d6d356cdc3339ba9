// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/tangent_bug.hpp"

#include <gtest/gtest.h>

#include "tangent_run.hpp"
#include "traps.hpp"

namespace cca::testing {
namespace {

TEST(TangentBug, DrivesStraightToAGoalInTheOpen) {
  const TangentRun end = run(BoxWorld{}, {0, 0, 0}, {5, 0});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_LT(end.distance, 5.02);
}

TEST(TangentBug, TurnsOnTheSpotForAGoalBehind) {
  const TangentRun end = run(BoxWorld{}, {0, 0, 0}, {-5, 0});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_LT(end.distance, 5.1);
}

TEST(TangentBug, CutsACornerCloseToTheShortestPath) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(0, 4.5, 6, 5.5);
  const TangentRun end = run(world, {1, 2, 0}, {1, 8});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_GE(end.clearance, 0.25);
  EXPECT_LT(end.distance, 13.1);
}

TEST(TangentBug, PassesADoorOfNinetyCentimetres) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(0, 4.9, 4.0, 5.1);
  world.add(4.9, 4.9, 10, 5.1);
  const TangentRun end = run(world, {8, 2, 0}, {2, 8});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_GE(end.clearance, 0.25);
}

TEST(TangentBug, ComesOutOfEveryTrapOrProvesItClosed) {
  for (const Trap& trap : allTraps()) {
    SCOPED_TRACE(trap.name);
    const TangentRun end = run(trap.world, trap.start, trap.goal);
    EXPECT_EQ(end.state,
              trap.reachable ? TangentBugState::kReached : TangentBugState::kUnreachable);
    EXPECT_GE(end.clearance, 0.25);
  }
}

}  // namespace
}  // namespace cca::testing
