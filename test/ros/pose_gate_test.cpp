// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/pose_gate.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

using Verdict = PoseGate::Verdict;

TEST(PoseGate, LetsAFastRobotDriveAndTurn) {
  PoseGate gate;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(gate.check({0.2 * i, 0.0, wrapAngle(0.3 * i)}, 0.1 * i), Verdict::kPlausible);
  }
}

TEST(PoseGate, LetsTheLocalisationCorrectItselfByHalfAMetre) {
  PoseGate gate;
  gate.check({0, 0, 0}, 0.0);
  EXPECT_EQ(gate.check({0.4, 0.2, 0.3}, 0.1), Verdict::kPlausible);
}

TEST(PoseGate, ForgetsASingleLeap) {
  PoseGate gate;
  gate.check({0, 0, 0}, 0.0);
  EXPECT_EQ(gate.check({9, 0, 0}, 0.1), Verdict::kHeld);
  EXPECT_EQ(gate.check({0.1, 0, 0}, 0.2), Verdict::kPlausible);
  EXPECT_EQ(gate.check({9, 0, 0}, 0.3), Verdict::kHeld);
}

TEST(PoseGate, HoldsATurnOnTheSpotThatNoRobotMakes) {
  PoseGate gate;
  gate.check({0, 0, 0}, 0.0);
  EXPECT_EQ(gate.check({0, 0, 3.0}, 0.1), Verdict::kHeld);
}

TEST(PoseGate, BelievesANewPlaceAfterASecondThere) {
  PoseGate gate;
  gate.check({0, 0, 0}, 0.0);
  for (double t = 1.0; t < 1.95; t += 0.1) EXPECT_EQ(gate.check({50, 0, 0}, t), Verdict::kHeld);
  EXPECT_EQ(gate.check({50, 0, 0}, 2.01), Verdict::kMoved);
  EXPECT_EQ(gate.check({50.1, 0, 0}, 2.1), Verdict::kPlausible);
}

TEST(PoseGate, DoesNotBelievePosesThatKeepLeaping) {
  PoseGate gate;
  gate.check({0, 0, 0}, 0.0);
  for (int i = 1; i < 50; ++i) {
    EXPECT_EQ(gate.check({(i % 2) ? 500.0 : 900.0, 0, 0}, 0.1 * i), Verdict::kHeld);
  }
}

}  // namespace
}  // namespace cca
