// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/progress_watch.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace cca {
namespace {

const Eigen::Vector2d kHere(1.0, 2.0);

struct At {
  Eigen::Vector2d x_map;
  double length;
};

/// The first time (s) at which it is stuck, of steps of 0.1 s until `end`; `end` where it is not.
double stuckAt(ProgressWatch& watch, double start, double end,
               const std::function<At(double)>& at) {
  for (double time = start; time < end; time += 0.1) {
    if (watch.stuck(at(time).x_map, at(time).length, time, false)) return time;
  }
  return end;
}

TEST(ProgressWatch, WhoeverStandsIsStuckWhenThePatienceEnds) {
  ProgressWatch watch;
  EXPECT_NEAR(stuckAt(watch, 0.0, 100.0,
                      [](double) {
                        return At{kHere, 0.0};
                      }),
              ProgressWatch::kPatience, 0.2);
}

TEST(ProgressWatch, WhoeverDrivesIsNotStuckWithOrWithoutABoundary) {
  for (const double walked : {0.0, 1.0}) {
    ProgressWatch watch;
    const auto at = [&](double time) {
      return At{kHere + 0.2 * time * Eigen::Vector2d::UnitX(), walked * 0.2 * time};
    };
    EXPECT_EQ(stuckAt(watch, 0.0, 200.0, at), 200.0);
  }
}

TEST(ProgressWatch, AWalkThatLeavesNoPlaceIsNotBelievedForLong) {
  ProgressWatch watch;
  const auto at = [](double time) { return At{kHere, 0.5 * time}; };
  const double first = stuckAt(watch, 0.0, 200.0, at);
  EXPECT_NEAR(first, 30.0, 0.2);
  EXPECT_NEAR(stuckAt(watch, first + 0.1, 200.0, at), first + 30.0, 0.4);
}

TEST(ProgressWatch, ANewWalkHasTheWholePatienceAndALengthOfItsOwn) {
  ProgressWatch watch;
  EXPECT_EQ(stuckAt(watch, 0.0, 5.0, [](double) { return At{kHere, 40.0}; }), 5.0);
  watch.startWalk(5.0);
  EXPECT_EQ(stuckAt(watch, 5.0, 20.0,
                    [](double time) {
                      return At{kHere, 0.1 * (time - 5.0)};
                    }),
            20.0);
}

TEST(ProgressWatch, WaitingForSomebodyDoesNotCount) {
  ProgressWatch watch;
  for (double time = 0.0; time < 60.0; time += 0.1) {
    EXPECT_FALSE(watch.stuck(kHere, 0.0, time, true));
  }
  EXPECT_NEAR(stuckAt(watch, 60.0, 100.0, [](double) { return At{kHere, 0.0}; }), 66.0, 0.3);
}

}  // namespace
}  // namespace cca
