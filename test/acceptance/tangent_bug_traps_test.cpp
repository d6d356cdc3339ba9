// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "../navigation/path_bound.hpp"
#include "../navigation/tangent_run.hpp"

namespace cca::testing {
namespace {

class TangentBugTrap : public ::testing::TestWithParam<Trap> {};

TEST_P(TangentBugTrap, EndsWithTheTruthWithinTheBoundOfThePaper) {
  const Trap& trap = GetParam();
  for (double range : {4.0, 8.0, 12.0}) {
    RunOptions options;
    options.range = range;
    const TangentRun end = run(trap.world, trap.start, trap.goal, options);
    EXPECT_EQ(end.state,
              trap.reachable ? TangentBugState::kReached : TangentBugState::kUnreachable);
    EXPECT_GE(end.clearance, options.robot.radius);
    EXPECT_LE(end.distance, tangentBugBound(trap, 0.3));
  }
}

INSTANTIATE_TEST_SUITE_P(Traps, TangentBugTrap, ::testing::ValuesIn(allTraps()),
                         [](const auto& trap) { return trap.param.name; });

}  // namespace
}  // namespace cca::testing
