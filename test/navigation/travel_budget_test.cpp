// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/travel_budget.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

TEST(TravelBudget, GrowsWhereNothingNewIsSeenAndIsPaidByWhatIs) {
  TravelBudget budget(80.0);
  budget.note({0, 0}, 20.0);
  EXPECT_EQ(budget.unpaid(), 0.0);
  budget.note({30, 0}, 20.0);
  budget.note({30, 40}, 20.0);
  EXPECT_DOUBLE_EQ(budget.unpaid(), 70.0);
  budget.note({30, 40}, 20.5);
  EXPECT_DOUBLE_EQ(budget.unpaid(), 30.0);
}

TEST(TravelBudget, IsNotPaidInAdvance) {
  TravelBudget budget(80.0);
  budget.note({0, 0}, 0.0);
  budget.note({1, 0}, 500.0);
  budget.note({11, 0}, 500.0);
  EXPECT_DOUBLE_EQ(budget.unpaid(), 10.0);
}

TEST(TravelBudget, TakesAWorldThatWasMadeAnewForNothingNew) {
  TravelBudget budget(80.0);
  budget.note({0, 0}, 50.0);
  budget.note({5, 0}, 49.0);
  budget.note({9, 0}, 49.0);
  EXPECT_DOUBLE_EQ(budget.unpaid(), 9.0);
}

}  // namespace
}  // namespace cca
