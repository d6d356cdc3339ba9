// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_closer.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

LoopVerdict goodLoop() {
  LoopVerdict verdict;
  verdict.score = 0.8;
  verdict.agreement = 1.0;
  verdict.common = 0.6;
  verdict.window = 5.6;
  verdict.sigma = 2.2;
  verdict.moved = 0.5;
  return verdict;
}

TEST(LoopCloser, ALoopThatRaysSpeakForIsCredible) { EXPECT_TRUE(isCredible(goodLoop())); }

// Between shelves 4.5 m apart all rays agree in the next aisle, too.
TEST(LoopCloser, WhatAgreesBeyondALikelyDriftIsNot) {
  LoopVerdict verdict = goodLoop();
  verdict.moved = 4.5;
  EXPECT_FALSE(isCredible(verdict));
  verdict.sigma = 3.5;
  EXPECT_TRUE(isCredible(verdict)) << "the wheels may have erred so far";
}

TEST(LoopCloser, AMatchThatSlidOutOfItsWindowIsNot) {
  LoopVerdict verdict = goodLoop();
  verdict.window = 0.6;
  verdict.moved = 1.5;
  EXPECT_FALSE(isCredible(verdict));
}

TEST(LoopCloser, APlaceWithARivalIsNot) {
  LoopVerdict verdict = goodLoop();
  verdict.has_rival = true;
  EXPECT_FALSE(isCredible(verdict));
}

TEST(LoopCloser, WiderWindowsAskRaysToAgreeMore) {
  LoopVerdict verdict = goodLoop();
  verdict.agreement = 0.85;
  EXPECT_FALSE(isCredible(verdict));
  verdict.window = 0.8;
  EXPECT_TRUE(isCredible(verdict));
}

}  // namespace
}  // namespace cca
