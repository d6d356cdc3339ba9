// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/hazard_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

TEST(HazardMemory, KeepsWhatIsOutOfSightAgain) {
  HazardMemory memory;
  memory.add({{1.0, 0.0}, {2.0, 1.0}}, 5.0);
  EXPECT_EQ(memory.around({0.0, 0.0}, 10.0).size(), 2u);
}

TEST(HazardMemory, ForgetsWhatIsOldOrFar) {
  HazardMemory memory;
  memory.add({{1.0, 0.0}}, 0.0);
  memory.add({{0.0, 1.0}}, 30.0);
  EXPECT_EQ(memory.around({0.0, 0.0}, HazardMemory::kAge + 1.0).size(), 1u);
  EXPECT_TRUE(memory.around({HazardMemory::kReach + 1.0, 1.0}, 31.0).empty());
  EXPECT_TRUE(memory.around({0.0, 0.0}, 31.0).empty()) << "for good";
}

TEST(HazardMemory, APointSeenAgainIsOneThatStaysYoung) {
  HazardMemory memory;
  for (int k = 0; k < 100; ++k) memory.add({{1.01, 0.01}}, k);
  EXPECT_EQ(memory.around({0.0, 0.0}, 99.0 + HazardMemory::kAge).size(), 1u);
}

TEST(HazardMemory, GoesAlongWhereTheFrameIsMoved) {
  HazardMemory memory;
  memory.add({{1.0, 0.0}}, 0.0);
  memory.move({2.0, 0.0, M_PI / 2.0});
  const auto points = memory.around({2.0, 0.0}, 1.0);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_LT((points[0] - Eigen::Vector2d(2.0, 1.0)).norm(), 1e-12);
}

TEST(HazardMemory, PassesOverWhatIsNoPlace) {
  HazardMemory memory;
  memory.add({{NAN, 0.0}, {0.0, INFINITY}, {1e300, 0.0}}, 0.0);
  EXPECT_TRUE(memory.around({0.0, 0.0}, 0.0).empty());
}

}  // namespace
}  // namespace cca
