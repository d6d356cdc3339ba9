// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/unpaid_way.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

TEST(UnpaidWay, GrowsWhereNothingNewIsSeenAndIsPaidByWhatIs) {
  UnpaidWay unpaid(80.0);
  unpaid.note({0, 0}, 20.0);
  EXPECT_EQ(unpaid.metres(), 0.0);
  unpaid.note({30, 0}, 20.0);
  unpaid.note({30, 40}, 20.0);
  EXPECT_DOUBLE_EQ(unpaid.metres(), 70.0);
  unpaid.note({30, 40}, 20.5);
  EXPECT_DOUBLE_EQ(unpaid.metres(), 30.0);
}

TEST(UnpaidWay, IsNotPaidInAdvance) {
  UnpaidWay unpaid(80.0);
  unpaid.note({0, 0}, 0.0);
  unpaid.note({1, 0}, 500.0);
  unpaid.note({11, 0}, 500.0);
  EXPECT_DOUBLE_EQ(unpaid.metres(), 10.0);
}

TEST(UnpaidWay, TakesAPlaceThatWasMadeAnewForNothingNew) {
  UnpaidWay unpaid(80.0);
  unpaid.note({0, 0}, 50.0);
  unpaid.note({5, 0}, 49.0);
  unpaid.note({9, 0}, 49.0);
  EXPECT_DOUBLE_EQ(unpaid.metres(), 9.0);
}

}  // namespace
}  // namespace cca
