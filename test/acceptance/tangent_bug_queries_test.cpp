// SPDX-License-Identifier: BSD-3-Clause
//
// CCA_TANGENT_BUG_QUERIES sets how many random worlds each test goes through, and
// CCA_TANGENT_BUG_FIRST from which seed on the first test starts, to share them among processes;
// docs/tangent_bug.md has the results of 1000.
#include <gtest/gtest.h>

#include <cstdlib>

#include "../navigation/mover_run.hpp"
#include "../navigation/random_worlds.hpp"
#include "../navigation/tangent_run.hpp"

namespace cca::testing {
namespace {

unsigned setting(const char* name, unsigned usual) {
  const char* text = std::getenv(name);
  return text ? static_cast<unsigned>(std::atoi(text)) : usual;
}

unsigned queries(unsigned usual) { return setting("CCA_TANGENT_BUG_QUERIES", usual); }

// The robot keeps 26.6 cm, or a few millimetres less where a corner hides between two beams. Where
// a disc of 26 cm passes, the cells of 2 cm that it crosses have 24.5 cm of room at their centres.
// At the goal there is room for the 7 cm from which it is worth leaving a boundary.
constexpr Band kBand{0.245, 0.28, 0.05};
// In noise it keeps up to 2 cm more, and gives up what it had to see to know better.
constexpr Band kNoisyBand{0.25, 0.33, 0.04};
constexpr double kGoalTolerance = 0.1;

constexpr double kRanges[] = {4.0, 8.0, 12.0};

TEST(TangentBugQueries, TheVerdictIsThatOfABreadthFirstSearch) {
  unsigned reached = 0, unreachable = 0, undecided = 0;
  double distance = 0.0;
  const unsigned first = setting("CCA_TANGENT_BUG_FIRST", 0), count = queries(20);
  for (unsigned seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE(seed);
    const Query query = randomQuery(seed);
    RunOptions options;
    options.range = kRanges[seed % 3];
    const TangentRun end = run(query.world, query.start, query.goal, options);
    distance += end.distance;
    EXPECT_GE(end.clearance, options.robot.radius);
    switch (TrueConfigurationSpace(query).verdict(kBand, kGoalTolerance)) {
      case Verdict::kReachable:
        ++reached;
        EXPECT_EQ(end.state, TangentBugState::kReached);
        break;
      case Verdict::kUnreachable:
        ++unreachable;
        EXPECT_EQ(end.state, TangentBugState::kUnreachable);
        break;
      case Verdict::kUndecided:
        ++undecided;
        EXPECT_TRUE(end.state == TangentBugState::kReached ||
                    end.state == TangentBugState::kUnreachable);
    }
  }
  std::printf("reachable %u, unreachable %u, undecided %u; %.0f m\n", reached, unreachable,
              undecided, distance);
}

// From afar the robot was promised a place 11 cm beside the goal, which a door post hid. It must
// believe its eyes again when it comes through that door and stands before the goal.
TEST(TangentBugQueries, AGoalBesideAPlaceThatWasPromisedInVainIsReached) {
  const Query query = randomQuery(597);
  RunOptions options;
  options.range = 4.0;
  const TangentRun end = run(query.world, query.start, query.goal, options);
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_LT(end.distance, 60.0);
}

// A corner that the thinned obstacle points leave out used to be touched.
TEST(TangentBugQueries, ACornerBetweenObstaclePointsIsNotTouched) {
  const Query query = randomQuery(2736);
  RunOptions options;
  options.range = 4.0;
  EXPECT_GE(run(query.world, query.start, query.goal, options).clearance, options.robot.radius);
}

// With noise of 1 to 5 cm: no collision, and every drive ends.
TEST(TangentBugQueries, NoNoiseLeadsIntoAWall) {
  unsigned right = 0, decided = 0, ended = 0;
  const unsigned count = queries(6);
  for (unsigned seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    const Query query = randomQuery(10000 + seed);
    RunOptions options;
    options.range = kRanges[seed % 3];
    options.noise = 0.01 * (1 + seed % 5);
    options.seed = seed;
    const TangentRun end = run(query.world, query.start, query.goal, options);
    EXPECT_GE(end.clearance, options.robot.radius);
    const bool reached = end.state == TangentBugState::kReached;
    ended += reached || end.state == TangentBugState::kUnreachable;
    const Verdict truth = TrueConfigurationSpace(query).verdict(kNoisyBand, kGoalTolerance);
    if (truth == Verdict::kUndecided) continue;
    ++decided;
    right += reached == (truth == Verdict::kReachable);
  }
  std::printf("ended %u of %u; right %u of %u\n", ended, count, right, decided);
  EXPECT_GE(right, decided * 9 / 10);  // noise may shut a gap that is little wider than the robot
}

// Ten walkers of up to 1 m/s who do not look where they go.
TEST(TangentBugQueries, TheMovingRobotTouchesNobody) {
  int moving = 0, standing = 0;
  double seconds = 0.0;
  for (unsigned seed = 0; seed < queries(6); ++seed) {
    RunOptions options;
    options.noise = 0.01;
    options.longest = 120.0;
    const MoverRun end = runAmongMovers(randomQuery(seed), 10, 1.0, options, seed);
    moving += end.contacts_while_moving;
    standing += end.contacts_while_standing;
    seconds += end.duration;
    EXPECT_GE(end.clearance, options.robot.radius) << seed;
    EXPECT_EQ(end.contacts_while_moving, 0) << seed;
  }
  std::printf("%.0f s; walked into while standing %d, touched while moving %d\n", seconds, standing,
              moving);
}

}  // namespace
}  // namespace cca::testing
