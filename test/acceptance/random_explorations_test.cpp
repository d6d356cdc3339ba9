// SPDX-License-Identifier: BSD-3-Clause
//
// Whole explorations of random small places, cluttered and narrow: every one ends by itself, and
// the robot touches nothing.
//
// CCA_RANDOM_EXPLORATIONS sets how many places each test goes through, CCA_RANDOM_FIRST the first
// seed, to share them among processes; docs/exploration.md has the results of 1000.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/building.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "simulation/random.hpp"

namespace cca {
namespace {

int setting(const char* name, int usual) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : usual;
}

/// 8 x 6 m: one or two inner walls with a door each, straight or turned boxes, and pillars. Nothing
/// keeps passages wide: some are too narrow for the robot, and parts may be cut off.
World randomPlace(int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  Building plan;
  plan.name = "place " + std::to_string(seed);
  plan.width = 8.0;
  plan.height = 6.0;
  plan.addOuterWalls(0.1);
  const double door = random.uniform(0.3, 4.0);
  const double wall = random.uniform(2.5, 5.5);
  plan.addWall({wall, 0.0}, {wall, 6.0}, 0.1, {{door, door + random.uniform(0.5, 1.4)}});
  if (random.uniform() < 0.6) {
    const double beside = random.uniform(0.3, wall - 1.3), height = random.uniform(2.0, 4.0);
    plan.addWall({0.0, height}, {wall, height}, 0.1, {{beside, beside + random.uniform(0.5, 1.0)}});
  }
  const int pieces = random.integer(0, 9);
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d centre(random.uniform(0.3, 7.7), random.uniform(0.3, 5.7));
    if (random.uniform() < 0.25) {
      plan.addDisc(centre, random.uniform(0.05, 0.35));
    } else {
      const Eigen::Vector2d size(random.uniform(0.1, 1.4), random.uniform(0.1, 0.8));
      plan.addTurnedBox(centre, size, random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, M_PI));
    }
  }
  return rasterise(plan, 0.05);
}

/// A place with this much room, or none after a thousand tries.
std::optional<Eigen::Vector2d> randomStand(const World& world, double room, Random& random) {
  for (int tries = 0; tries < 1000; ++tries) {
    const Eigen::Vector2d p(random.uniform(0.4, 7.6), random.uniform(0.4, 5.6));
    if (world.clearance(p, room) >= room) return p;
  }
  return {};
}

std::vector<Mover> randomWalkers(const World& world, const Eigen::Vector2d& start, int count,
                                 Random& random) {
  std::vector<Mover> walkers;
  for (int i = 0; i < count; ++i) {
    Mover walker;
    walker.body.half_size.setConstant(random.uniform(0.1, 0.25));
    walker.speed = random.uniform(0.2, 1.0);
    walker.gap = i % 2 ? 0.4 : 0.0;  // every other one is blind
    const auto p = randomStand(world, walker.body.radius() + 0.05, random);
    if (!p || (*p - start).norm() < 0.5 + walker.body.radius()) continue;
    walker.body.T_map_body = {p->x(), p->y(), 0.0};
    walkers.push_back(walker);
  }
  return walkers;
}

struct Outcome {
  int runs = 0, ended = 0, collisions = 0, mover_contacts = 0;
  double distance = 0.0, time = 0.0, least_coverage = 1.0, coverage = 0.0;
};

/// s. Half an hour is sixty times what the slowest place takes without noise and movers.
constexpr double kLongestTime = 1800.0;

struct Trial {
  LaserParameters laser;
  int movers = 0;
  RobotParameters robot = {}, told = {};           ///< as it is, and as the planner is told
  double period = RunParameters{}.control_period;  ///< s, between two scans
  double corrections = 0.0;  ///< s, between two corrections of the past, by what it was; 0: none
};

/// Makes navigation anew from time to time, as a localisation may that finds loops.
class Corrections {
 public:
  explicit Corrections(double period) : period_(period), due_(period) {}

  void note(const Observation& observation) {
    if (period_ == 0.0) return;
    past_.add({observation.scan, {}, {}}, observation.T_map_robot);
    truth_.push_back(observation.T_map_robot);
  }
  void tell(double time, Explorer& explorer) {
    if (period_ == 0.0 || time < due_) return;
    due_ += period_;
    past_.correct(truth_, std::vector<bool>(truth_.size(), true));
    explorer.correct(past_);
  }

 private:
  double period_, due_;  // s
  PastScans past_;
  std::vector<Pose2> truth_;
};

void explore(int seed, const Trial& trial, Outcome& outcome) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const World world = randomPlace(seed);
  Random random(static_cast<std::uint64_t>(seed) + 1000000);
  const auto start = randomStand(world, 0.36, random);
  if (!start) return;
  const Parameters parameters;
  SimulationParameters simulated;
  simulated.seed = static_cast<std::uint64_t>(seed);
  simulated.laser = trial.laser;
  simulated.robot = trial.robot;
  const Pose2 T_map_start{start->x(), start->y(), random.uniform(-M_PI, M_PI)};
  Simulation simulation(world, T_map_start, simulated,
                        randomWalkers(world, *start, trial.movers, random));
  Explorer explorer(trial.told, parameters.exploration);
  Coverage coverage(simulation.world(), *start, simulated.robot.radius, simulated.laser.range);
  Corrections corrections(trial.corrections);
  bool finished = false;
  std::string reason;
  while (!finished && simulation.time() < kLongestTime) {
    const Observation observation = simulation.observe();
    corrections.tell(observation.time, explorer);
    const Action action = explorer.step(observation);
    corrections.note(observation);
    coverage.look(simulation.T_map_robot());
    finished = action.status == ExplorationStatus::kFinished;
    reason = action.reason;
    if (!finished) simulation.drive(action.velocity, trial.period);
  }
  const double seen = coverage.curve().back();
  EXPECT_TRUE(finished) << "not after " << simulation.distance() << " m";
  EXPECT_EQ(simulation.collisions(), 0);
  ++outcome.runs;
  outcome.ended += finished;
  outcome.collisions += simulation.collisions();
  outcome.mover_contacts += simulation.moverContacts();
  outcome.distance += simulation.distance();
  outcome.time += simulation.time();
  outcome.coverage += seen;
  outcome.least_coverage = std::min(outcome.least_coverage, seen);
  if (std::getenv("CCA_RANDOM_VERBOSE")) {
    std::printf("seed %d: %s, %.1f m, %.0f s, %.4f seen, %d collisions, %d mover contacts; %s\n",
                seed, finished ? "ended" : "HANGS", simulation.distance(), simulation.time(), seen,
                simulation.collisions(), simulation.moverContacts(), reason.c_str());
    std::fflush(stdout);
  }
}

template <class TrialOf>
void exploreAll(int usual, TrialOf&& trial_of) {
  Outcome outcome;
  const int first = setting("CCA_RANDOM_FIRST", 0);
  const int count = setting("CCA_RANDOM_EXPLORATIONS", usual);
  for (int seed = first; seed < first + count; ++seed) explore(seed, trial_of(seed), outcome);
  std::printf(
      "%d runs, %d ended, %d collisions, %d contacts by movers with the standing robot; "
      "%.1f km, %.1f h; seen %.4f on average, %.4f at least\n",
      outcome.runs, outcome.ended, outcome.collisions, outcome.mover_contacts,
      outcome.distance / 1e3, outcome.time / 3600.0, outcome.coverage / std::max(outcome.runs, 1),
      outcome.least_coverage);
  EXPECT_GT(outcome.runs, 0);
}

constexpr double kRanges[] = {4.0, 8.0, 12.0};

Trial ofRange(int seed) {
  Trial trial;
  trial.laser.range = kRanges[seed % 3];
  return trial;
}

TEST(RandomExplorations, EndAndTouchNothing) { exploreAll(4, ofRange); }

// Passages little wider than the robot, which noise shuts on the grid from one scan to the next.
TEST(RandomExplorations, SeeWhatLiesBehindPassagesOfTheRobotsWidth) {
  Outcome outcome;
  for (const int seed : {59, 224, 433, 436, 704}) explore(seed, ofRange(seed), outcome);
  EXPECT_GT(outcome.coverage / outcome.runs, 0.98);
}

// A wall of which a bend is cut off, whose ends are joined, and that then takes the bend back: the
// line map went round in circles within one scan.
TEST(RandomExplorations, WhereAWallIsBentAgainByWhatWasCutOffEnd) {
  Outcome outcome;
  Trial trial;
  trial.laser.range = 12.0;
  explore(194, trial, outcome);
  EXPECT_EQ(outcome.runs, 1);
}

TEST(RandomExplorations, InNoiseEndAndTouchNothing) {
  exploreAll(2, [](int seed) {
    Trial trial;
    trial.laser.range = kRanges[seed % 3];
    trial.laser.range_noise = 0.01 * (1 + seed % 5);
    return trial;
  });
}

Trial amongMovers(int seed) {
  Trial trial;
  trial.laser.range = kRanges[seed % 3];
  trial.movers = 1 + seed % 10;
  return trial;
}

TEST(RandomExplorations, AmongMoversEndAndTheDrivingRobotTouchesNobody) {
  exploreAll(2, amongMovers);
}

// Somebody who leans against the robot for two seconds, lets it set off, and turns back.
TEST(RandomExplorations, AmongMoversWhoPauseTheDrivingRobotTouchesNobody) {
  Outcome outcome;
  explore(180, amongMovers(180), outcome);
  EXPECT_EQ(outcome.runs, 1);
}

// Door posts that the robot sees no longer, and has not seen for long, when it turns beside them.
TEST(RandomExplorations, WithANarrowFieldOfViewTouchNoPostBesideThem) {
  Outcome outcome;
  Trial trial;
  trial.laser.range = 8.0;
  trial.laser.field_of_view_deg = 90.0;
  trial.laser.beams = 91;
  explore(310, trial, outcome);
  EXPECT_EQ(outcome.runs, 1);
}

Trial ofNarrowView(int seed) {
  constexpr double kFieldsOfView[] = {90.0, 120.0, 180.0, 240.0, 270.0};
  Trial trial;
  trial.laser.range = kRanges[seed % 3];
  trial.laser.field_of_view_deg = kFieldsOfView[seed % 5];
  trial.laser.beams = 1 + static_cast<int>(trial.laser.field_of_view_deg);
  return trial;
}

TEST(RandomExplorations, WithANarrowFieldOfViewEndAndTouchNothing) { exploreAll(2, ofNarrowView); }

// The far side of a box that was seen end on only, beside the robot in a curve around it.
TEST(RandomExplorations, WithANarrowFieldOfViewTouchNothingUnseen) {
  Outcome outcome;
  explore(750, ofNarrowView(750), outcome);
  explore(1430, ofNarrowView(1430), outcome);
  EXPECT_EQ(outcome.runs, 2);
}

// A goal that is given up for one right here, to be looked at to the side, while the robot drives.
TEST(RandomExplorations, WithANarrowFieldOfViewStandBeforeTheyTurnToLook) {
  Outcome outcome;
  explore(215, ofNarrowView(215), outcome);
  EXPECT_EQ(outcome.runs, 1);
}

// Places that were looked at, the goal, its time and the robot's patience all survive them.
TEST(RandomExplorations, WithANarrowFieldOfViewAndCorrectionsEndAndTouchNothing) {
  exploreAll(2, [](int seed) {
    Trial trial = ofNarrowView(seed);
    trial.corrections = 3.0;
    return trial;
  });
}

Trial ofLateRobot(int seed, double latency, double told) {
  Trial trial;
  trial.laser.range = kRanges[seed % 3];
  trial.robot.latency = latency;
  trial.told.latency = told;
  return trial;
}

TEST(RandomExplorations, WithLateCommandsEndAndTouchNothing) {
  for (const double latency : {0.1, 0.2, 0.3}) {
    exploreAll(2, [&](int seed) { return ofLateRobot(seed, latency, latency); });
  }
}

// Corners that one scan reads too far: by the next, the command that leads past them is on its way.
TEST(RandomExplorations, WithLateCommandsTouchNoCorner) {
  Outcome outcome;
  explore(29, ofLateRobot(29, 0.3, 0.3), outcome);
  explore(151, ofLateRobot(151, 0.2, 0.2), outcome);
  EXPECT_EQ(outcome.runs, 2);
}

// Until a command acts, walkers come nearer.
TEST(RandomExplorations, AmongMoversWithLateCommandsTheDrivingRobotTouchesNobody) {
  for (const double latency : {0.15, 0.3}) {
    exploreAll(3, [&](int seed) {
      Trial trial = amongMovers(seed);
      trial.robot.latency = trial.told.latency = latency;
      return trial;
    });
  }
}

TEST(RandomExplorations, WithCommandsLaterThanToldEndAndTouchNothing) {
  exploreAll(3, [](int seed) { return ofLateRobot(seed, 0.15, 0.0); });
}

TEST(RandomExplorations, WithCommandsLessLateThanToldEndAndTouchNothing) {
  exploreAll(2, [](int seed) { return ofLateRobot(seed, 0.0, 0.15); });
}

TEST(RandomExplorations, WithSlowLasersEndAndTouchNothing) {
  for (const double period : {0.2, 0.3}) {
    exploreAll(2, [&](int seed) {
      Trial trial = ofLateRobot(seed, 0.15, 0.15);
      trial.period = period;
      return trial;
    });
  }
}

Trial ofWeakBrakes(int seed) {
  Trial trial = ofLateRobot(seed, 0.15, 0.15);
  trial.robot.max_linear_acceleration *= 0.5;
  return trial;
}

TEST(RandomExplorations, WithBrakesWeakerThanToldEndAndTouchNothing) {
  exploreAll(2, ofWeakBrakes);
}

// Odometry that reads too fast once, while the robot brakes.
TEST(RandomExplorations, WithBrakesWeakerThanToldBrakeWhateverTheOdometryReads) {
  Outcome outcome;
  explore(7, ofWeakBrakes(7), outcome);
  explore(52, ofWeakBrakes(52), outcome);
  EXPECT_EQ(outcome.runs, 2);
}

}  // namespace
}  // namespace cca
