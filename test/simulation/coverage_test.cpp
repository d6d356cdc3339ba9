// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/coverage.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

World hall(double metres) {
  const int side = static_cast<int>(metres / 0.05);
  const std::vector<unsigned char> free(static_cast<std::size_t>(side) * side, 0);
  return World("hall", side, side, free, 0.05, {0.0, 0.0});
}

TEST(Coverage, IsTheShareOfWhatCanBeSeen) {
  const World world = hall(10.0);
  Coverage coverage(world, {5.0, 5.0}, 0.25, 8.0);
  coverage.look({5.0, 5.0, 0.0});
  const auto curve = coverage.curve();
  ASSERT_EQ(curve.size(), 1U);
  EXPECT_GT(curve.back(), 0.8);  // between the farthest beams lie cells
  EXPECT_LT(curve.back(), 1.0);
  EXPECT_EQ(*coverage.sofar(), curve.back());
}

TEST(Coverage, OfALargeWorldIsGivenUpAtOnce) {
  const World world = hall(150.0);  // a minute and more to work out
  Coverage coverage(world, {75.0, 75.0}, 0.25, 30.0);
  coverage.look({75.0, 75.0, 0.0});
  EXPECT_FALSE(coverage.sofar().has_value());
  coverage.giveUp();
  EXPECT_TRUE(coverage.curve().empty());
  EXPECT_FALSE(coverage.sofar().has_value());
}

}  // namespace
}  // namespace cca
