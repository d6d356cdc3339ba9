// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/known_map/known_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdio>
#include <limits>

#include "sensing/undistortion.hpp"
#include "walled_plan.hpp"

namespace cca {
namespace {

using test::PlannedWorld;

/// Its walls are known.
PlannedWorld ring() { return PlannedWorld(test::ringWithNiches()); }

struct Followed {
  std::vector<Estimate> estimates;
  std::vector<Pose2> truth;
  double worst(std::size_t from = 0) const {
    double worst = 0.0;
    for (std::size_t k = from; k < truth.size(); ++k) {
      worst = std::max(worst, (estimates[k].T_map_robot.position() - truth[k].position()).norm());
    }
    return worst;
  }
};

Followed drive(KnownMap& localiser, test::WalledWorld& world, const std::vector<Pose2>& way) {
  Followed run;
  const std::vector<Pose2> wheels = test::wheelsOf(way, world);
  for (std::size_t k = 0; k < way.size(); ++k) {
    run.estimates.push_back(localiser.localise(test::measurementAt(world, way[k], wheels[k])));
    run.truth.push_back(way[k]);
  }
  return run;
}

const Eigen::Matrix3d kAbout = Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal();

TEST(KnownMap, FollowsADriveAlthoughTheWheelsErrAndThePlanShowsNoFurniture) {
  PlannedWorld place = ring();
  place.world.addBox(7.0, 0.0, 8.0, 0.4);
  place.world.addBox(18.0, 7.0, 18.5, 8.0);
  place.world.addBox(9.0, 15.5, 10.5, 16.0);
  const std::vector<Pose2> way = test::driveAroundRing(0.1);
  KnownMap localiser(place.plan);
  localiser.place({way[0].x + 0.2, way[0].y - 0.1, way[0].theta + 0.1}, kAbout);
  const Followed run = drive(localiser, place.world, way);
  EXPECT_TRUE(std::all_of(run.estimates.begin(), run.estimates.end(),
                          [](const Estimate& e) { return e.is_known; }));
  EXPECT_EQ(localiser.timesLost(), 0);
  EXPECT_LT(run.worst(), 0.1);
}

constexpr double kSweep = 0.18;  // s, of a turn of the laser; the next one follows at once
constexpr int kBeams = 240;
constexpr double kFieldOfView = 359.0 * M_PI / 180.0;  // rad

/// Each beam from where a laser that moves by `motion` is by then; `pose` in the middle.
Scan sweptFrom(test::WalledWorld& world, const Pose2& pose, const Twist& motion) {
  Scan swept = world.scan(pose, kBeams, kFieldOfView);
  swept.sweep_duration = kSweep;
  for (std::size_t k = 0; k < swept.size(); ++k) {
    const double time = kSweep * (static_cast<double>(k) / (kBeams - 1) - 0.5);
    swept.ranges[k] = world.scan(pose * moveBy(motion, time), kBeams, kFieldOfView, 0.01).ranges[k];
  }
  return swept;
}

/// rad, rms of the heading: a robot drives in circles, and its wheels tell a turn that changes
/// within each sweep by .9 degrees, which it does not.
double headingErrorOfASweptDrive(bool tells_how_it_was_undone) {
  PlannedWorld room = test::roomWithNiche();
  const Twist motion{{0.3, 0.0}, 0.5};
  Pose2 pose{4.0, 1.5, 0.0};
  KnownMap localiser(room.plan);
  localiser.place(pose, kAbout);
  double square = 0.0;
  constexpr int kScans = 30;
  for (int k = 0; k < kScans; ++k) {
    const double error = (k % 4 < 2 ? 1.0 : -1.0) * 0.09;  // rad/s
    const Twist before{motion.linear, motion.angular - error};
    const Twist after{motion.linear, motion.angular + error};
    const auto half = [](const Twist& twist) {
      return Pose2{0.5 * kSweep * twist.linear.x(), 0.0, 0.5 * kSweep * twist.angular};
    };
    Measurement measurement;
    measurement.scan = undistort(sweptFrom(room.world, pose, motion), before, after);
    measurement.T_odom_robot = pose;
    if (tells_how_it_was_undone) measurement.undone = SweptScan{{half(before), half(after)}, 1.0};
    const Estimate estimate = localiser.localise(measurement);
    EXPECT_TRUE(estimate.is_known);
    const double off = wrapAngle(estimate.T_map_robot.theta - pose.theta);
    square += off * off / kScans;
    pose = pose * moveBy(motion, kSweep);
  }
  return std::sqrt(square);
}

TEST(KnownMap, UndoesASweepByWhatTheLastScansSawWhereTheWheelsErr) {
  EXPECT_LT(headingErrorOfASweptDrive(true), 0.5 * headingErrorOfASweptDrive(false));
}

TEST(KnownMap, ItsCovarianceIsThatOfItsErrorsInAPlanWhoseLinesAreOff) {
  PlannedWorld place = ring();
  for (auto& [a, b] : place.plan) {
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector2d off = 0.02 * place.world.noise() * Eigen::Vector2d(-along.y(), along.x());
    a += off;
    b += off;
  }
  const std::vector<Pose2> way = test::driveAroundRing(0.1);
  KnownMap localiser(place.plan);
  localiser.place(way[0], kAbout);
  const Followed run = drive(localiser, place.world, way);
  double nees = 0.0;
  for (std::size_t k = 0; k < way.size(); ++k) {
    const Eigen::Vector3d e = difference(run.estimates[k].T_map_robot, run.truth[k]);
    nees += e.dot(run.estimates[k].covariance.inverse() * e) / static_cast<double>(way.size());
  }
  std::printf("NEES %.2f, plan off by %.4f m as learned\n", nees, localiser.planSigma());
  EXPECT_GT(nees, 0.5);  // the mean of chi^2(3) is 3
  EXPECT_LT(nees, 7.0);
}

TEST(KnownMap, AScanWithoutAPoseToldIsFoundAnywhereAndSaysSo) {
  PlannedWorld room = test::roomWithNiche();
  KnownMap localiser(room.plan);
  const Pose2 truth{2.5, 2.0, 0.7};
  Estimate estimate;
  estimate.is_known = false;
  for (int k = 0; k < 30 && !estimate.is_known; ++k) {
    estimate = localiser.localise(test::measurementAt(room.world, truth, {}));
  }
  ASSERT_TRUE(estimate.is_known);
  EXPECT_LT((estimate.T_map_robot.position() - truth.position()).norm(), 0.03);
}

TEST(KnownMap, NoticesWithinAMetreThatItWasCarriedAndFindsItself) {
  PlannedWorld place = ring();
  std::vector<Pose2> way = test::driveAroundRing(0.1);
  KnownMap localiser(place.plan);
  localiser.place(way[0], kAbout);
  const std::size_t carried = 60, carried_to = 260;
  const std::vector<Pose2> wheels = test::wheelsOf(way, place.world);
  for (std::size_t k = 0; k < carried; ++k) {
    localiser.localise(test::measurementAt(place.world, way[k], wheels[k]));
  }
  double noticed = -1.0, found = -1.0, driven = 0.0;
  Estimate estimate;
  for (std::size_t k = carried_to; k < way.size() && driven < 6.0; ++k) {
    driven += (way[k].position() - way[k - 1].position()).norm();
    // The wheels go on as if nothing had been.
    const Pose2 told = wheels[carried] * wheels[carried_to].inverse() * wheels[k];
    estimate = localiser.localise(test::measurementAt(place.world, way[k], told));
    if (noticed < 0.0 && !estimate.is_known) noticed = driven;
    if (noticed >= 0.0 && found < 0.0 && estimate.is_known) {
      found = driven;
      EXPECT_LT((estimate.T_map_robot.position() - way[k].position()).norm(), 0.2);
    }
  }
  EXPECT_GT(noticed, 0.0);
  EXPECT_LE(noticed, 1.0);
  EXPECT_GT(found, 0.0);
  EXPECT_LE(found, 5.0);
}

/// By a laser that loses one beam in thirty.
Measurement lossy(test::WalledWorld& world, const Pose2& pose, const Pose2& wheels) {
  Measurement measurement = test::measurementAt(world, pose, wheels);
  for (double& range : measurement.scan.ranges) {
    if (world.noise() > 1.83) range = std::numeric_limits<double>::infinity();
  }
  return measurement;
}

// Each scan is a new view, and the oldest is dropped before all candidates have been asked of all.
TEST(KnownMap, IsFoundWhileViewsComeFasterThanTheSearch) {
  PlannedWorld place = ring();
  LocalisationEffort little;
  little.matches = 20;
  KnownMap localiser(place.plan, {}, little);
  const std::vector<Pose2> way = test::driveAroundRing(0.6);
  const std::vector<Pose2> wheels = test::wheelsOf(way, place.world);
  std::size_t found = way.size();
  for (std::size_t k = 0; k < way.size(); ++k) {
    Measurement measurement = lossy(place.world, way[k], wheels[k]);
    measurement.scan.free_range_without_return = 0.0;  // what MissingReturns makes of lone ones
    const Estimate estimate = localiser.localise(measurement);
    if (!estimate.is_known) continue;
    found = std::min(found, k);
    EXPECT_LT((estimate.T_map_robot.position() - way[k].position()).norm(), 0.1) << "scan " << k;
  }
  EXPECT_LT(found, way.size() / 2);
}

const Pose2 kAslant{1.3, -0.7, 0.5};  // of a building on the map

/// Thirty metres of niches, then walls without any, farther than the laser sees; aslant.
PlannedWorld corridorThatEndsInBlankWalls() {
  PlannedWorld place;
  const auto wall = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    place.addWall(kAslant * a, kAslant * b);
  };
  for (double x = 0.0; x < 30.0; x += 2.0) {
    wall({x, 0.0}, {x, 0.4});
    wall({x, 0.4}, {x + 0.8, 0.4});
    wall({x + 0.8, 0.4}, {x + 0.8, 0.0});
  }
  wall({0.0, 0.0}, {120.0, 0.0});
  wall({0.0, 3.0}, {120.0, 3.0});
  return place;
}

TEST(KnownMap, WheelsThatCountShortAreLearnedAndServeWhereThePlanSaysNothing) {
  PlannedWorld place = corridorThatEndsInBlankWalls();
  KnownMap localiser(place.plan);
  Estimate estimate;
  double error = 0.0;
  for (double x = 2.0; x < 65.0; x += 0.1) {
    const Pose2 truth = kAslant * Pose2{x, 1.6, 0.0};
    if (x == 2.0) localiser.place(truth, kAbout);
    estimate = localiser.localise(lossy(place.world, truth, {0.93 * x, 1.6, 0.0}));
    error = (estimate.T_map_robot.position() - truth.position()).norm();
  }
  EXPECT_TRUE(estimate.is_known);
  EXPECT_LT(error, 0.02 * 15.0);  // 7 % of the last 15 m are 1.05 m
}

/// The share of a way that is localised towards the wall between two rooms, which is in the plan.
/// Of glass, no beam meets it; a mirror, beams meet what is before it. All is turned by half a
/// radian.
double localisedBeforeAPane(bool is_glass) {
  const Pose2 T_plan_room{1.3, -0.7, 0.5};
  PlannedWorld rooms = test::roomWithNiche(), place;
  rooms.addBox(8.0, 0.0, 14.0, 4.0);
  for (const auto& [a, b] : rooms.plan) {
    place.plan.emplace_back(T_plan_room * a, T_plan_room * b);
    const bool is_pane = a.x() == 8.0 && b.x() == 8.0, is_behind = a.x() + b.x() > 16.0;
    if (is_pane || (is_behind && !is_glass)) continue;
    place.world.addWall(T_plan_room * a, T_plan_room * b);
    const Eigen::Vector2d mirrored_a{16.0 - a.x(), a.y()}, mirrored_b{16.0 - b.x(), b.y()};
    if (!is_glass) place.world.addWall(T_plan_room * mirrored_a, T_plan_room * mirrored_b);
  }
  KnownMap localiser(place.plan);
  int localised = 0;
  constexpr int kScans = 120;  // 3.6 m towards the pane, a round of 1.2 rad
  for (int k = 0; k < kScans; ++k) {
    const Pose2 pose = T_plan_room * Pose2{2.0 + 0.03 * k, 2.0 + 0.005 * k, 0.3 + 0.01 * k};
    if (k == 0) localiser.place(pose, kAbout);
    const Estimate estimate = localiser.localise(lossy(place.world, pose, pose));
    localised +=
        estimate.is_known && (estimate.T_map_robot.position() - pose.position()).norm() < 0.05;
  }
  return static_cast<double>(localised) / kScans;
}

TEST(KnownMap, IsLocalisedBeforeGlassAndMirrors) {
  EXPECT_GT(localisedBeforeAPane(true), 0.98);
  EXPECT_GT(localisedBeforeAPane(false), 0.98);
}

TEST(KnownMap, IsLostWhereThePlanDoesNotGoOn) {
  PlannedWorld room = test::roomWithNiche();
  // Another place, which the robot is told to be that room.
  test::WalledWorld other;
  other.addBox(-6.0, -2.0, 12.0, 14.0);
  KnownMap localiser(room.plan);
  localiser.place({2.5, 2.0, 0.0}, kAbout);
  Estimate estimate;
  for (int k = 0; k < 30; ++k) {
    const Pose2 pose{2.5 + 0.05 * k, 2.0, 0.0};
    estimate = localiser.localise(test::measurementAt(other, pose, pose));
  }
  EXPECT_FALSE(estimate.is_known);
}

/// A bare corridor of 24 x 2 m, with doors in the wall at y = 2. @param doors  where they begin and
/// end, x, m.
PlannedWorld corridor(const std::vector<double>& doors) {
  PlannedWorld place;
  double from = 0.0;
  for (std::size_t k = 0; k < doors.size(); k += 2) {
    place.addWall({from, 2.0}, {doors[k], 2.0});
    from = doors[k + 1];
  }
  place.addWall({from, 2.0}, {24.0, 2.0});
  place.addWall({0.0, 0.0}, {24.0, 0.0});
  place.addWall({0.0, 0.0}, {0.0, 2.0});
  place.addWall({24.0, 0.0}, {24.0, 2.0});
  return place;
}

/// Along it to the door at x = 16, through that to `depth` [m] from where it turns, and once
/// around.
std::vector<Pose2> wayIntoTheRoom(double depth) {
  std::vector<Pose2> way;
  for (int k = 0; k <= 150; ++k) way.push_back({1.0 + 0.1 * k, 1.0, 0.0});
  for (int k = 0; k < 16; ++k) way.push_back({16.0, 1.0, 0.1 * k});
  for (int k = 0; k <= std::lround(depth / 0.1); ++k) {
    way.push_back({16.0, 1.0 + 0.1 * k, M_PI_2});
  }
  const double y = way.back().y;
  for (int k = 0; k < 63; ++k) way.push_back({16.0, y, wrapAngle(M_PI_2 + 0.1 * k)});
  return way;
}

/// Two rooms that are alike, of which the plan shows the first alone.
PlannedWorld corridorWithAnUndrawnRoom() {
  PlannedWorld place = corridor({3.5, 4.5, 15.5, 16.5});
  const auto room = [](PlannedWorld& to, double x) {
    to.addWall({x, 2.0}, {x, 6.0});
    to.addWall({x, 6.0}, {x + 4.0, 6.0});
    to.addWall({x + 4.0, 6.0}, {x + 4.0, 2.0});
    to.addBox(x + 0.5, 5.2, x + 1.3, 6.0);
  };
  place.addBox(8.0, 0.0, 9.0, 0.6);
  room(place, 2.0);
  PlannedWorld undrawn;
  room(undrawn, 14.0);
  for (const auto& [a, b] : undrawn.plan) place.world.addWall(a, b);
  return place;
}

TEST(KnownMap, ARobotThatLeavesThePlanIsNotToldToBeInARoomThatIsAlike) {
  PlannedWorld place = corridorWithAnUndrawnRoom();
  const std::vector<Pose2> way = wayIntoTheRoom(3.0);
  // Who has not come along the corridor is deceived: no scan tells the rooms apart.
  KnownMap deceived(place.plan);
  Estimate estimate;
  for (int k = 0; k < 63; ++k) {
    const Pose2 turned{16.0, 4.0, 0.1 * k};
    estimate = deceived.localise(test::measurementAt(place.world, turned, turned));
  }
  ASSERT_TRUE(estimate.is_known);
  EXPECT_NEAR(estimate.T_map_robot.x, 4.0, 0.1);
  KnownMap localiser(place.plan);
  localiser.place(way[0], kAbout);
  const Followed run = drive(localiser, place.world, way);
  for (std::size_t k = 0; k < way.size(); ++k) {
    const double off = (run.estimates[k].T_map_robot.position() - way[k].position()).norm();
    EXPECT_TRUE(!run.estimates[k].is_known || off < 0.3) << "scan " << k << ", off by " << off;
  }
}

/// A room of which the plan does not show the furniture.
PlannedWorld corridorWithAFurnishedRoom() {
  PlannedWorld place = corridor({15.5, 16.5});
  place.addWall({13.0, 2.0}, {13.0, 8.0});
  place.addWall({13.0, 8.0}, {19.0, 8.0});
  place.addWall({19.0, 8.0}, {19.0, 2.0});
  place.world.addBox(13.0, 7.4, 17.2, 8.0);
  place.world.addBox(18.4, 3.0, 19.0, 7.2);
  place.world.addBox(13.0, 3.2, 13.6, 4.6);
  return place;
}

TEST(KnownMap, ARobotInAFurnishedRoomIsNotLost) {
  PlannedWorld place = corridorWithAFurnishedRoom();
  const std::vector<Pose2> way = wayIntoTheRoom(4.5);
  KnownMap localiser(place.plan);
  localiser.place(way[0], kAbout);
  const Followed run = drive(localiser, place.world, way);
  for (std::size_t k = 0; k < way.size(); ++k) {
    EXPECT_TRUE(run.estimates[k].is_known) << "scan " << k;
  }
  EXPECT_LT(run.worst(), 0.1);
  EXPECT_EQ(localiser.timesLost(), 0);
}

/// A room with cupboards half a metre before one wall, each other one 12 cm deeper, and with a
/// shelf, .3 m deep, before the opposite wall. A partition tells it from itself turned round.
PlannedWorld roomWithCupboards() {
  PlannedWorld place;
  place.addBox(0.0, 0.0, 6.0, 7.0);
  place.addWall({2.0, 7.0}, {2.0, 4.5});
  for (int k = 0; k < 14; ++k) {
    const double face = k % 2 == 0 ? 5.44 : 5.56;
    place.world.addWall({face, 0.5 * k}, {face, 0.5 * (k + 1)});
  }
  place.world.addWall({0.3, 0.0}, {0.3, 5.5});
  place.world.addWall({0.3, 5.5}, {0.0, 5.5});
  return place;
}

// A little to one side the shelf, or the cupboards, are where the plan has the wall.
TEST(KnownMap, AFoundRobotStaysWhereItWasFound) {
  PlannedWorld place = roomWithCupboards();
  const Pose2 truth{3.2, 3.0, 0.4};
  KnownMap localiser(place.plan);
  Estimate estimate;
  estimate.is_known = false;
  for (int k = 0; k < 20 && !estimate.is_known; ++k) {
    estimate = localiser.localise(test::measurementAt(place.world, truth, truth));
  }
  ASSERT_TRUE(estimate.is_known);
  EXPECT_NEAR(estimate.T_map_robot.x, truth.x, 0.1);
  EXPECT_NEAR(estimate.T_map_robot.y, truth.y, 0.1);
}

TEST(KnownMap, WhatTheLinesErrByTogetherIsInTheCovariance) {
  const double offset = 0.03, angle = 0.01;
  PlannedWorld place = ring();
  const std::vector<Pose2> way = test::driveAroundRing(0.1);
  KnownMap sure(place.plan);
  KnownMap unsure(place.plan, std::vector<LineSigma>(place.plan.size(), {offset, angle}));
  Eigen::Matrix3d difference = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 50; ++k) {
    if (k == 0) sure.place(way[0], kAbout);
    if (k == 0) unsure.place(way[0], kAbout);
    const Measurement seen = test::measurementAt(place.world, way[k], way[k]);
    const Estimate b = unsure.localise(seen), a = sure.localise(seen);
    EXPECT_NEAR(a.T_map_robot.x, b.T_map_robot.x, 0.02);
    difference = b.covariance - a.covariance;
  }
  EXPECT_GE(difference(0, 0), offset * offset);
  EXPECT_GE(difference(1, 1), offset * offset);
  EXPECT_GE(difference(2, 2), angle * angle);
}

TEST(KnownMap, ALineThatTheMapKnowsLessWellPullsLess) {
  PlannedWorld room = test::roomWithNiche();
  std::vector<LineSigma> sigmas(room.plan.size(), {0.005, 0.001});
  sigmas[0].offset = 0.05;  // both faces of a wall, drawn as one line between them
  for (auto* end : {&room.plan[0].first, &room.plan[0].second}) end->y() -= 0.04;
  const Pose2 truth{2.5, 2.0, 0.7};
  double off[2];
  for (int knows = 0; knows < 2; ++knows) {
    KnownMap localiser(room.plan, knows ? sigmas : std::vector<LineSigma>());
    localiser.place(truth, kAbout);
    Estimate estimate;
    for (int k = 0; k < 10; ++k) {
      estimate = localiser.localise(test::measurementAt(room.world, truth, truth));
    }
    off[knows] = std::abs(estimate.T_map_robot.y - truth.y);
  }
  EXPECT_LT(off[1], 0.6 * off[0]);
}

TEST(KnownMap, EmptyPlansAndEmptyScansLocaliseNothing) {
  PlannedWorld room = test::roomWithNiche();
  KnownMap nowhere({});
  EXPECT_FALSE(nowhere.localise(test::measurementAt(room.world, {2.5, 2.0, 0.7}, {})).is_known);
  KnownMap blind(room.plan);
  Measurement dark;
  dark.scan.ranges.assign(360, HUGE_VAL);
  dark.scan.angle_increment = 2.0 * M_PI / 360.0;
  EXPECT_FALSE(blind.localise(dark).is_known);
}

TEST(KnownMap, TheSameScansGiveTheSamePosesToTheBit) {
  std::vector<Pose2> poses[2];
  for (auto& found : poses) {
    PlannedWorld place = ring();
    KnownMap localiser(place.plan);
    std::vector<Pose2> way = test::driveAroundRing(0.1);
    way.resize(100);
    for (const Estimate& e : drive(localiser, place.world, way).estimates) {
      found.push_back(e.T_map_robot);
    }
  }
  for (std::size_t k = 0; k < poses[0].size(); ++k) {
    EXPECT_EQ(poses[0][k].x, poses[1][k].x);
    EXPECT_EQ(poses[0][k].theta, poses[1][k].theta);
  }
}

}  // namespace
}  // namespace cca
