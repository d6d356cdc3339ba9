// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace cca {
namespace {

TEST(ProgressClock, RunsFromTheFirstTimeThatProgressIsExpected) {
  ProgressClock clock;
  EXPECT_FALSE(clock.isOver(0.0, 100.0)) << "none is expected yet";
  clock.run(2.0);
  clock.run(3.0);
  EXPECT_FALSE(clock.isOver(5.0, 7.0));
  EXPECT_TRUE(clock.isOver(5.0, 7.1));
  clock.restart(7.0);
  EXPECT_FALSE(clock.isOver(5.0, 12.0));
  clock.stop();
  EXPECT_FALSE(clock.isOver(5.0, 100.0));
}

const RobotParameters kRobot;
constexpr double kPatience = 10.0 + 2.0 * 3.14159265358979323846 / 1.5;  // s, of the default robot

/// The first time (s) at which it is stuck, of steps of 0.1 s; `end` where it is not.
/// @param left  m, of a straight way, at a time.
double stuckAt(PathProgress& progress, double start, double end,
               const std::function<double(double)>& left) {
  for (double time = start; time < end; time += 0.1) {
    progress.note(1, {{0.0, 0.0}, {left(time), 0.0}}, time, kRobot);
    if (progress.isStuck(time, kRobot)) return time;
  }
  return end;
}

TEST(PathProgress, WhoeverStandsIsStuckWhenThePatienceEndsAndThenHasItAnew) {
  PathProgress progress;
  const double first = stuckAt(progress, 0.0, 100.0, [](double) { return 5.0; });
  EXPECT_NEAR(first, kPatience, 0.2);
  EXPECT_NEAR(stuckAt(progress, first, 100.0, [](double) { return 5.0; }), first + kPatience, 0.2);
}

TEST(PathProgress, WhoeverComesNearerIsNotStuckHoweverSlow) {
  PathProgress progress;
  EXPECT_EQ(stuckAt(progress, 0.0, 500.0, [](double time) { return 6.0 - 0.01 * time; }), 500.0);
}

TEST(PathProgress, ToAndFroIsNoProgress) {
  PathProgress progress;
  const auto left = [](double time) { return 5.0 - 0.3 * std::sin(time); };
  EXPECT_NEAR(stuckAt(progress, 0.0, 100.0, left), kPatience + 1.6, 0.3);
  EXPECT_NEAR(progress.shortest().back().x(), 4.7, 0.03);
}

TEST(PathProgress, AnotherWayToTheSameGoalHasAPatienceOfItsOwn) {
  PathProgress progress;
  const auto left = [](double time) { return time < 12.0 ? 1.0 : 32.0 - time; };
  EXPECT_EQ(stuckAt(progress, 0.0, 30.0, left), 30.0);
}

TEST(PathProgress, AMapThatIsCorrectedGivesNoPatience) {
  PathProgress progress;
  const auto left = [&](double time) {
    const bool is_due = std::fmod(time, 3.0) < 0.1;
    if (is_due) progress.correctPath();
    return 5.0 + 0.3 * std::floor(time / 3.0);
  };
  EXPECT_NEAR(stuckAt(progress, 0.0, 100.0, left), kPatience, 0.2);
}

TEST(PathProgress, AGoalHasTheTimeOfItsWayAtAFifthOfFullSpeedAndHalfAMinute) {
  PathProgress progress;
  progress.note(1, {{0.0, 0.0}, {7.0, 0.0}}, 100.0, kRobot);
  EXPECT_FALSE(progress.isOverdue(179.9));
  EXPECT_TRUE(progress.isOverdue(180.1));
  progress.note(2, {{0.0, 0.0}, {0.7, 0.0}}, 180.1, kRobot);
  EXPECT_FALSE(progress.isOverdue(215.0));
  EXPECT_TRUE(progress.isOverdue(215.2));
}

TEST(PathProgress, StandingStillByOrderIsExcused) {
  PathProgress progress;
  progress.note(1, {{0.0, 0.0}, {0.7, 0.0}}, 0.0, kRobot);
  progress.pauseTimers(1000.0);
  EXPECT_FALSE(progress.isStuck(1010.0, kRobot));
  EXPECT_FALSE(progress.isOverdue(1034.9)) << "30 s, and 0.7 m at a fifth of full speed";
  EXPECT_TRUE(progress.isOverdue(1035.1));
  progress.note(2, {{0.0, 0.0}, {14.0, 0.0}}, 1040.0, kRobot);
  progress.pauseTimers(1041.0);
  for (const double time : {1050.0, 1060.0, 2000.0}) progress.pauseTimers(time);
  EXPECT_FALSE(progress.isOverdue(2129.0)) << "what time it had is not taken away";
  EXPECT_TRUE(progress.isOverdue(2131.0));
}

const Eigen::Vector2d kHere(1.0, 2.0);

struct At {
  Eigen::Vector2d x_map;
  double length;
};

/// The first time (s) at which it is stuck, of steps of 0.1 s until `end`; `end` where it is not.
double stuckAt(WalkProgress& watch, double start, double end, const std::function<At(double)>& at) {
  for (double time = start; time < end; time += 0.1) {
    if (watch.isStuck(at(time).x_map, at(time).length, time, false)) return time;
  }
  return end;
}

TEST(WalkProgress, WhoeverStandsIsStuckWhenThePatienceEnds) {
  WalkProgress watch;
  EXPECT_NEAR(stuckAt(watch, 0.0, 100.0,
                      [](double) {
                        return At{kHere, 0.0};
                      }),
              WalkProgress::kPatience, 0.2);
}

TEST(WalkProgress, WhoeverDrivesIsNotStuckWithOrWithoutABoundary) {
  for (const double walked : {0.0, 1.0}) {
    WalkProgress watch;
    const auto at = [&](double time) {
      return At{kHere + 0.2 * time * Eigen::Vector2d::UnitX(), walked * 0.2 * time};
    };
    EXPECT_EQ(stuckAt(watch, 0.0, 200.0, at), 200.0);
  }
}

TEST(WalkProgress, ANewWalkHasTheWholePatienceAndALengthOfItsOwn) {
  WalkProgress watch;
  EXPECT_EQ(stuckAt(watch, 0.0, 5.0, [](double) { return At{kHere, 40.0}; }), 5.0);
  watch.startWalk(5.0);
  EXPECT_EQ(stuckAt(watch, 5.0, 20.0,
                    [](double time) {
                      return At{kHere, 0.1 * (time - 5.0)};
                    }),
            20.0);
}

TEST(WalkProgress, WaitingForSomebodyDoesNotCount) {
  WalkProgress watch;
  for (double time = 0.0; time < 60.0; time += 0.1) {
    EXPECT_FALSE(watch.isStuck(kHere, 0.0, time, true));
  }
  EXPECT_NEAR(stuckAt(watch, 60.0, 100.0, [](double) { return At{kHere, 0.0}; }), 66.0, 0.3);
}

}  // namespace
}  // namespace cca
