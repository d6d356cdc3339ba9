// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/circling.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

// Walks along a circle; angle and length grow together.
void walkCircle(Circling& circling, double radius, double from, double to) {
  for (double a = from; a <= to; a += 0.02) {
    circling.add({radius * std::cos(a), radius * std::sin(a)}, radius * a, a);
  }
}

TEST(Circling, ClosesAfterAWholeTurnWithSomeOverlap) {
  Circling circling;
  walkCircle(circling, 2.0, 0.0, 2.0 * M_PI);
  EXPECT_FALSE(circling.closed()) << "the start has only just been met";
  walkCircle(circling, 2.0, 2.0 * M_PI, 2.0 * M_PI + 0.6);
  EXPECT_TRUE(circling.closed());
}

TEST(Circling, GoingBackAlongACorridorsOtherSideIsNoLoop) {
  Circling circling;
  double length = 0.0;
  for (double x = 0.0; x < 10.0; x += 0.05) circling.add({x, 0.0}, length += 0.05, 0.0);
  for (double x = 10.0; x > -5.0; x -= 0.05) circling.add({x, 0.05}, length += 0.05, M_PI);
  EXPECT_FALSE(circling.closed());
}

TEST(Circling, StandingStillIsNoLoop) {
  Circling circling;
  for (int i = 0; i < 1000; ++i) circling.add({1.0, 1.0}, 0.0, 0.01 * i);
  EXPECT_FALSE(circling.closed());
}

TEST(Circling, CrossingTheStartOnAnotherHeadingIsNoLoop) {
  Circling circling;
  double length = 0.0;
  for (double x = -2.0; x < 5.0; x += 0.05) circling.add({x, 0.0}, length += 0.05, 0.0);
  for (double y = -3.0; y < 3.0; y += 0.05) circling.add({0.0, y}, length += 0.05, 1.5 * M_PI);
  EXPECT_FALSE(circling.closed());
}

TEST(Circling, ForgetsOnReset) {
  Circling circling;
  walkCircle(circling, 2.0, 0.0, 2.0 * M_PI + 0.6);
  circling.reset();
  EXPECT_FALSE(circling.closed());
}

}  // namespace
}  // namespace cca
