// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/aside_goals.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

TEST(AsideGoals, AreAsideUntilTenSquareMetresHaveBeenSeen) {
  AsideGoals goals;
  goals.add({10, 10}, 500);
  EXPECT_TRUE(goals.contains({10, 10}, 500));
  EXPECT_TRUE(goals.contains({10, 10}, 4499));
  EXPECT_FALSE(goals.contains({10, 10}, 4500));
}

TEST(AsideGoals, NeighboursAreTheSameGoal) {
  AsideGoals goals;
  goals.add({10, 10}, 0);
  EXPECT_TRUE(goals.contains({13, 7}, 0));
  EXPECT_FALSE(goals.contains({14, 10}, 0));
}

TEST(AsideGoals, AWayIsLostAgainTheSecondTime) {
  AsideGoals goals;
  EXPECT_FALSE(goals.noteLostWay({10, 10}));
  EXPECT_FALSE(goals.noteLostWay({20, 20}));
  EXPECT_TRUE(goals.noteLostWay({12, 9}));
  EXPECT_FALSE(goals.contains({10, 10}, 0)) << "lost is not yet aside";
}

}  // namespace
}  // namespace cca
