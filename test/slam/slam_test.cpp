// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <functional>
#include <limits>
#include <thread>

#include "geometry/cross.hpp"
#include "slam/graph_back_end.hpp"
#include "walled_world.hpp"

namespace cca {
namespace {

double worstError(const std::vector<Pose2>& poses, const std::vector<Pose2>& truth) {
  double worst = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    worst = std::max(worst, (poses[k].position() - truth[k].position()).norm());
  }
  return worst;
}

struct Drive {
  test::WalledWorld world;
  std::vector<Pose2> way, wheels;
  std::vector<Scan> scans;
  explicit Drive(double field_of_view = M_PI, double step = 0.4,
                 test::WalledWorld in = test::ringWithNiches(), double longest = 8.0)
      : world(std::move(in)), way(test::driveAroundRing(step)), wheels(test::wheelsOf(way, world)) {
    for (const Pose2& pose : way)
      scans.push_back(world.scan(pose, 181, field_of_view, 0.01, longest));
  }
};

TEST(Slam, BringsARingOfCorridorsHomeOnDriftingWheels) {
  Drive drive;
  EXPECT_GT(worstError(drive.wheels, drive.way), 2.0) << "else nothing is shown";
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) {
    slam.step(drive.scans[k], {}, drive.wheels[k]);
  }
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.15);
}

TEST(Slam, TakesTheLaserFromWhereItIsMounted) {
  Drive drive;
  const Pose2 T_robot_sensor{0.3, 0.1, 0.2};
  Slam slam(drive.way.front() * T_robot_sensor.inverse());
  for (std::size_t k = 0; k < drive.way.size(); ++k) {
    slam.step(drive.scans[k], T_robot_sensor, drive.wheels[k] * T_robot_sensor.inverse());
  }
  slam.finish();
  std::vector<Pose2> sensors;
  for (const Pose2& pose : slam.trajectory()) sensors.push_back(pose * T_robot_sensor);
  EXPECT_LT(worstError(sensors, drive.way), 0.15);
}

// A covariance of zero would make a filter believe the pose whatever others say.
TEST(Slam, TellsTheCovarianceOfEachMatchThatOfAKeyFrameToo) {
  Drive drive(2.0 * M_PI);
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < 40; ++k) {
    const SlamPose pose = slam.step(drive.scans[k], {}, drive.wheels[k]);
    if (k == 0) continue;
    EXPECT_GT(pose.covariance.selfadjointView<Eigen::Upper>().eigenvalues().minCoeff(), 0.0) << k;
  }
  EXPECT_GT(slam.graph().size(), 3) << "else nothing is shown";
}

TEST(Slam, NeedsNoWheelsWhereTheLaserSeesEnough) {
  Drive drive(2.0 * M_PI, 0.1, test::ringWithNiches(), 20.0);  // m, the ends of each corridor
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) slam.step(drive.scans[k], {}, std::nullopt);
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.05);
}

TEST(Slam, TheSameInputGivesTheSameBits) {
  Drive drive;
  const auto run = [&] {
    Slam slam(drive.way.front());
    for (std::size_t k = 0; k < drive.way.size(); ++k) {
      slam.step(drive.scans[k], {}, drive.wheels[k]);
    }
    slam.finish();
    return slam.trajectory();
  };
  const auto once = run(), again = run();
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].x, again[k].x);
    EXPECT_EQ(once[k].theta, again[k].theta);
  }
}

TEST(Slam, EachScanSearchesABitOrTakesOneStepOfTheGraph) {
  Drive drive;
  Slam slam(drive.way.front());
  SlamWork all;
  for (std::size_t k = 0; k < drive.way.size(); ++k) {
    slam.step(drive.scans[k], {}, drive.wheels[k]);
    EXPECT_LE(slam.work().searches + slam.work().iterations, 1) << k;
    all += slam.work();
  }
  EXPECT_FALSE(slam.loops().empty()) << "else nothing is shown";
  EXPECT_GT(all.searches, 5);
  EXPECT_GT(all.iterations, 2);
  slam.finish();
  EXPECT_TRUE(slam.isSettled());
}

TEST(Slam, ALoopIsClosedWhileTheRobotGoesOn) {
  Drive drive;
  Slam slam(drive.way.front());
  double before = 0.0, after = 0.0;
  std::size_t loops = 0;
  for (std::size_t k = 0; k < drive.way.size(); ++k) {
    const SlamPose pose = slam.step(drive.scans[k], {}, drive.wheels[k]);
    const double error = (pose.T_map_robot.position() - drive.way[k].position()).norm();
    if (slam.loops().empty()) before = std::max(before, error);
    if (!slam.isSettled() || slam.loops().empty()) continue;
    after = std::max(after, error);
    ++loops;
  }
  EXPECT_GT(loops, 10u);
  EXPECT_LT(after, before) << "of the poses given scan by scan";
}

TEST(Slam, TwoThreadsFinishWithTheSameBitsAsOne) {
  Drive drive;
  const auto run = [&](const DoAll& do_all) {
    Slam slam(drive.way.front());
    for (std::size_t k = 0; k < drive.way.size(); ++k) {
      slam.step(drive.scans[k], {}, drive.wheels[k]);
    }
    slam.finish(do_all);
    return slam.trajectory();
  };
  int shared = 0;
  const auto by_two = [&](int count, const std::function<void(int)>& task) {
    const auto every_second = [&](int first) {
      for (int k = first; k < count; k += 2) task(k);
    };
    std::thread other(every_second, 1);
    every_second(0);
    other.join();
    shared += count;
  };
  const auto alone = run(doInTurn), together = run(by_two);
  EXPECT_GT(shared, 10) << "else nothing is shown";
  for (std::size_t k = 0; k < alone.size(); ++k) {
    EXPECT_EQ(alone[k].x, together[k].x);
    EXPECT_EQ(alone[k].y, together[k].y);
    EXPECT_EQ(alone[k].theta, together[k].theta);
  }
}

TEST(Slam, ScansOfNothingAreDrivenThroughOnTheWheels) {
  Drive drive;
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) {
    Scan scan = drive.scans[k];
    if (k % 30 > 25) std::fill(scan.ranges.begin(), scan.ranges.end(), HUGE_VAL);
    slam.step(scan, {}, drive.wheels[k]);
  }
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.3);
}

/// m, of a drive at 10 Hz through the hall; along its bare walls wheels alone know how far.
double worstErrorOf(const Drive& drive, const std::vector<Scan>& scans,
                    const std::vector<Pose2>& wheels) {
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) slam.step(scans[k], {}, wheels[k]);
  slam.finish();
  return worstError(slam.trajectory(), drive.way);
}

TEST(Slam, AWheelThatSpinsForTwoSecondsBendsNothing) {
  const Drive drive(M_PI, 0.1, test::hallWithBlocks());
  std::vector<Pose2> wheels{drive.wheels.front()};
  for (std::size_t k = 1; k < drive.wheels.size(); ++k) {
    Pose2 step = drive.wheels[k - 1].inverse() * drive.wheels[k];
    if (k >= 60 && k < 80) step = step * Pose2{0.05, 0.0, 0.1};
    wheels.push_back(wheels.back() * step);
  }
  const double without = worstErrorOf(drive, drive.scans, drive.wheels);
  EXPECT_LT(worstErrorOf(drive, drive.scans, wheels), without + 0.1);
  EXPECT_LT(without, 1.0);
}

TEST(Slam, PeopleWhoWalkByBendNothing) {
  const Drive drive(M_PI, 0.1, test::hallWithBlocks());
  std::vector<Scan> scans = drive.scans;
  std::size_t hidden = 0;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    for (int person = 0; person < 3; ++person) {  // each crosses the view in four seconds
      const double part = std::fmod(0.025 * static_cast<double>(k) + 0.33 * person, 1.0);
      const Eigen::Vector2d at(1.5 + person, 4.0 * part - 2.0);
      for (std::size_t i = 0; i < scans[k].size(); ++i) {
        const Eigen::Vector2d ray(std::cos(scans[k].bearing(i)), std::sin(scans[k].bearing(i)));
        const double along = ray.dot(at), beside = std::abs(cross(ray, at));
        if (along <= 0.0 || beside >= 0.25) continue;
        const double range = along - std::sqrt(0.0625 - beside * beside);
        hidden += range < scans[k].ranges[i];
        scans[k].ranges[i] = std::min(scans[k].ranges[i], range);
      }
    }
  }
  EXPECT_GT(hidden, 10 * scans.size()) << "else nothing is shown";
  const double without = worstErrorOf(drive, drive.scans, drive.wheels);
  EXPECT_LT(worstErrorOf(drive, scans, drive.wheels), without + 0.1);
}

TEST(Slam, ABareCorridorOfTwoHundredMetresStaysAsStraightAsItIs) {
  test::WalledWorld world;
  world.addBox(-20.0, -1.0, 220.0, 1.0);  // its ends are never seen
  std::vector<Pose2> way;
  for (double x = 0.0; x < 200.0; x += 0.2) way.push_back({x, 0.2 * std::sin(x), 0.0});
  const std::vector<Pose2> wheels = test::wheelsOf(way, world);
  Slam slam;
  for (std::size_t k = 0; k < way.size(); ++k) {
    slam.step(world.scan(way[k], 181, M_PI, 0.01, 8.0), {}, wheels[k]);
  }
  slam.finish();
  const std::vector<Pose2> poses = slam.trajectory();
  double across = 0.0, across_by_wheels = 0.0, along = 0.0, along_by_wheels = 0.0;
  for (std::size_t k = 0; k < way.size(); ++k) {
    across = std::max(across, std::abs(poses[k].y - way[k].y));
    along = std::max(along, std::abs(poses[k].x - way[k].x));
    const Pose2 by_wheels = wheels.front().inverse() * wheels[k];
    across_by_wheels = std::max(across_by_wheels, std::abs(by_wheels.y - way[k].y));
    along_by_wheels = std::max(along_by_wheels, std::abs(by_wheels.position().norm() - way[k].x));
  }
  EXPECT_LT(across, 1.0);
  EXPECT_GT(across_by_wheels, 10.0) << "else nothing is shown";
  EXPECT_LT(along, 1.5 * along_by_wheels)
      << "the wheels' own error, along which the walls say nothing";
}

TEST(Slam, WallsThatTellHowFarTeachTheWheelsWhatABareCorridorBeforeThemWas) {
  test::WalledWorld world;
  world.addBox(-20.0, -1.0, 60.0, 1.0);  // its ends are never seen
  for (double x = 22.0; x < 34.0; x += 3.0) world.addBox(x, 0.4, x + 0.5, 1.0);
  std::vector<Pose2> way, wheels;
  for (double x = 0.0; x < 30.0; x += 0.1) {
    way.push_back({x, 0.0, 0.0});
    wheels.push_back({1.03 * x, 0.0, 0.0});
  }
  Slam slam;
  for (std::size_t k = 0; k < way.size(); ++k) {
    slam.step(world.scan(way[k], 181, M_PI, 0.01, 8.0), {}, wheels[k]);
  }
  slam.finish();
  EXPECT_GT(worstError(wheels, way), 0.8) << "else nothing is shown";
  EXPECT_LT(worstError(slam.trajectory(), way), 0.06);
}

TEST(Slam, ATurnThatTheWheelsKnowNothingOfIsFound) {
  Drive drive;
  std::vector<Pose2> wheels = drive.wheels;
  const std::size_t lifted = 20;
  const Pose2 turned{0.0, 0.0, 1.4};
  for (std::size_t k = lifted; k < wheels.size(); ++k) {
    wheels[k] = wheels[lifted - 1] * turned.inverse() * (wheels[lifted - 1].inverse() * wheels[k]);
  }
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) slam.step(drive.scans[k], {}, wheels[k]);
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.3);
}

TEST(Slam, OneScanThatAgreesElsewhereTurnsNothing) {
  Drive drive;
  const std::size_t bumped = 20;
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) {
    Pose2 T_map_sensor = drive.way[k];
    if (k == bumped) T_map_sensor = T_map_sensor * Pose2{0.0, 0.0, 1.4};
    const Scan scan = drive.world.scan(T_map_sensor, 181, M_PI, 0.01, 8.0);
    const SlamPose pose = slam.step(scan, {}, drive.wheels[k]);
    if (k == bumped) {
      EXPECT_LT(pose.agreement, 0.7);
      EXPECT_LT(std::abs(wrapAngle(pose.T_map_robot.theta - drive.way[k].theta)), 0.3);
    }
  }
  EXPECT_FALSE(slam.isLocalised()[bumped]);
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.3);
}

/// What a laser sees while the robot nods: a floor that begins so far ahead.
Scan nodding(Scan scan, double floor) {
  for (std::size_t k = 0; k < scan.size(); ++k) {
    const double ahead = std::cos(scan.bearing(k));
    if (ahead > 0.1) scan.ranges[k] = std::min(scan.ranges[k], floor / ahead);
  }
  return scan;
}

TEST(Slam, TheFloorThatANoddingRobotSeesMovesNothingAndIsSetAside) {
  const std::vector<double> floor{3.0, 1.4, 1.05, 1.0, 1.0, 1.3};  // m, scan by scan
  for (const double noise : {0.005, 0.01, 0.02}) {
    Drive drive(1.2 * M_PI, 0.05);
    for (std::size_t k = 0; k < drive.way.size(); ++k) {
      drive.scans[k] = drive.world.scan(drive.way[k], 157, 1.2 * M_PI, noise, 20.0);
    }
    const std::vector<std::size_t> brakes{150, 400, 700, 1000};
    for (const std::size_t begin : brakes) {
      for (std::size_t i = 0; i < floor.size(); ++i) {
        drive.scans[begin + i] = nodding(drive.scans[begin + i], floor[i]);
      }
    }
    Slam slam(drive.way.front());
    for (std::size_t k = 0; k < drive.way.size(); ++k) {
      slam.step(drive.scans[k], {}, drive.wheels[k]);
      EXPECT_FALSE(slam.isLost()) << k;
    }
    slam.finish();
    EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.1) << noise;
    const std::vector<bool> is_set_aside = slam.isSetAside();
    for (const std::size_t begin : brakes) EXPECT_TRUE(is_set_aside[begin + 3]) << begin;
    EXPECT_LE(std::count(is_set_aside.begin(), is_set_aside.end(), true), 6 * 4);
  }
}

TEST(Slam, ARobotCarriedInsideItsOwnMapIsLostAndFindsItselfThere) {
  for (const double carried : {2.0, 3.0, 5.0}) {  // m, around the corner, the wheels silent
    const double step = 0.1;
    const Drive whole(2.0 * M_PI, step, test::hallWithBlocks(), 12.0);
    std::vector<Pose2> way, wheels;
    std::vector<Scan> scans;
    // Lifted a metre before the corner where the second round begins, set down behind it.
    const std::size_t lifted = 575, turning = 12;
    const std::size_t set_down = lifted + turning + static_cast<std::size_t>(carried / step);
    Pose2 T_odom_robot = whole.wheels.front();
    for (std::size_t k = 0; k < whole.way.size(); ++k) {
      if (k > lifted && k < set_down) continue;
      if (k > 0 && k != set_down) {
        T_odom_robot = T_odom_robot * (whole.wheels[k - 1].inverse() * whole.wheels[k]);
      }
      way.push_back(whole.way[k]);
      wheels.push_back(T_odom_robot);
      scans.push_back(whole.scans[k]);
    }
    Slam slam(way.front());
    std::size_t lost = 0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      slam.step(scans[k], {}, wheels[k]);
      lost += slam.isLost();
    }
    slam.finish();
    // From two metres on one jump takes it there, from farther off the map has to be searched.
    EXPECT_TRUE(lost > 0 || carried < 3.0) << "else nothing is shown";
    EXPECT_LT(lost, 50u) << carried;
    const std::vector<bool> is_placed = slam.isLocalised();
    EXPECT_LE(std::count(is_placed.begin(), is_placed.end(), false), 12) << carried;
    const std::vector<Pose2> poses = slam.trajectory();
    for (std::size_t k = 0; k < way.size(); ++k) {
      if (!is_placed[k]) continue;
      EXPECT_LT((poses[k].position() - way[k].position()).norm(), 0.1) << carried << " at " << k;
    }
  }
}

TEST(Slam, ACarriedRobotIsLostWhileItTurnsOnTheSpot) {
  const Drive whole(2.0 * M_PI, 0.1, test::hallWithBlocks(), 12.0);
  const std::size_t lifted = 575, set_down = 637;  // the wheels silent
  Slam slam(whole.way.front());
  for (std::size_t k = 0; k <= lifted; ++k) slam.step(whole.scans[k], {}, whole.wheels[k]);
  ASSERT_FALSE(slam.isLost());
  test::WalledWorld world = whole.world;
  for (int turn = 0; turn < 20; ++turn) {
    const Pose2 turned{0.0, 0.0, 0.15 * turn};
    slam.step(world.scan(whole.way[set_down] * turned, 181, 2.0 * M_PI, 0.01, 12.0), {},
              whole.wheels[lifted] * turned);
  }
  EXPECT_TRUE(slam.isLost()) << "all scans are of one place, and it is not here";
}

TEST(Slam, WheelsThatCountAlikeForwardsAndBackwardsAreSeenThrough) {
  Drive drive(M_PI, 0.4, test::hallWithBlocks());
  std::vector<std::size_t> order;  // towards a wall, back, and on
  for (std::size_t k = 0; k <= 20; ++k) order.push_back(k);
  for (std::size_t k = 19; k >= 10; --k) order.push_back(k);
  for (std::size_t k = 11; k < drive.way.size(); ++k) order.push_back(k);
  Slam slam(drive.way.front());
  Pose2 wheels;
  std::vector<Pose2> truth;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0) {
      Pose2 step = drive.wheels[order[i - 1]].inverse() * drive.wheels[order[i]];
      if (order[i] < order[i - 1]) step = {-step.x, -step.y, step.theta};
      wheels = wheels * step;
    }
    slam.step(drive.scans[order[i]], {}, wheels);
    truth.push_back(drive.way[order[i]]);
  }
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), truth), 0.2);
}

TEST(Slam, OdometryThatBeginsAnewMovesNothing) {
  Drive drive;
  for (const std::size_t restart : {drive.way.size() / 3, drive.way.size() / 2}) {
    EXPECT_GT(drive.wheels[restart - 1].position().norm(), 5.0) << "else nothing is shown";
    Slam slam(drive.way.front());
    for (std::size_t k = 0; k < drive.way.size(); ++k) {
      const Pose2 begun = k < restart ? Pose2{} : drive.wheels[restart];
      slam.step(drive.scans[k], {}, begun.inverse() * drive.wheels[k]);
    }
    slam.finish();
    EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.15) << restart;
  }
}

/// Goes on with the part of a drive from `first` on, on wheels that know nothing of where that is.
void goOn(Slam& slam, const Drive& drive, std::size_t first) {
  for (std::size_t k = first; k < drive.way.size(); ++k) {
    slam.step(drive.scans[k], {}, drive.wheels[first].inverse() * drive.wheels[k]);
  }
}

TEST(Slam, ASecondDriveThroughAKnownPlaceFindsItself) {
  const Drive known(M_PI, 0.4, test::hallWithBlocks()), again(M_PI, 0.35, test::hallWithBlocks());
  const std::size_t first = again.way.size() / 3;
  Slam slam(known.way.front());
  for (std::size_t k = 0; k < known.way.size(); ++k) slam.step(known.scans[k], {}, known.wheels[k]);
  slam.startAnywhere();
  EXPECT_TRUE(slam.step(again.scans[first], {}, Pose2{}).is_lost) << "one scan is no proof";
  goOn(slam, again, first);
  EXPECT_FALSE(slam.isLost());
  slam.finish();
  std::vector<Pose2> poses = slam.trajectory();
  poses.erase(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(known.way.size() + 1));
  EXPECT_LT(
      worstError(poses, {again.way.begin() + static_cast<std::ptrdiff_t>(first), again.way.end()}),
      0.2);
}

TEST(Slam, ADriveThroughAnotherBuildingIsNotInTheMap) {
  const Drive known, other(M_PI, 0.4, test::hallWithBlocks());
  Slam slam(known.way.front());
  for (std::size_t k = 0; k < known.way.size(); ++k) slam.step(known.scans[k], {}, known.wheels[k]);
  slam.startAnywhere();
  goOn(slam, other, 0);
  slam.finish();
  const std::vector<bool> placed = slam.isLocalised();
  const auto in_map = std::count(placed.begin(), placed.end(), true);
  EXPECT_TRUE(in_map == static_cast<std::ptrdiff_t>(known.way.size()) ||
              in_map == static_cast<std::ptrdiff_t>(other.way.size()))
      << in_map;
}

SlamMemory memoryOf(const Drive& drive) {
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) slam.step(drive.scans[k], {}, drive.wheels[k]);
  slam.finish();
  return slam.memory();
}

TEST(Slam, ADriveGoesOnWithTheMapOfAnEarlierOneAndInItsFrame) {
  const Drive known(M_PI, 0.4, test::hallWithBlocks()), again(M_PI, 0.35, test::hallWithBlocks());
  const std::size_t first = again.way.size() / 3;
  Slam slam;
  slam.remember(memoryOf(known));
  const auto remembered = static_cast<std::size_t>(slam.remembered());
  ASSERT_GT(remembered, 10u);
  EXPECT_FALSE(slam.step(again.scans[first], {}, Pose2{}).is_lost) << "its own drive is the map";
  EXPECT_FALSE(slam.isInMemory());
  const std::vector<bool> placed = slam.isLocalised();
  EXPECT_EQ(std::count(placed.begin(), placed.end(), true), 1);
  goOn(slam, again, first);
  EXPECT_TRUE(slam.isInMemory());
  slam.finish();
  std::vector<Pose2> poses = slam.trajectory();
  poses.erase(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(remembered + 1));
  EXPECT_LT(
      worstError(poses, {again.way.begin() + static_cast<std::ptrdiff_t>(first), again.way.end()}),
      0.2);
  EXPECT_GT(slam.memory().graph.size(), static_cast<int>(remembered)) << "both drives are kept";
}

TEST(Slam, TheMemoryOfAnotherBuildingIsNoPartOfTheMap) {
  const Drive known, other(M_PI, 0.4, test::hallWithBlocks());
  Slam slam(other.way.front());
  slam.remember(memoryOf(known));
  for (std::size_t k = 0; k < other.way.size(); ++k) slam.step(other.scans[k], {}, other.wheels[k]);
  slam.finish();
  EXPECT_FALSE(slam.isInMemory());
  const std::vector<bool> placed = slam.isLocalised();
  EXPECT_EQ(std::count(placed.begin(), placed.begin() + slam.remembered(), true), 0);
  EXPECT_EQ(std::count(placed.begin() + slam.remembered(), placed.end(), true),
            static_cast<std::ptrdiff_t>(other.way.size()));
}

TEST(Slam, TwoMemoriesOfOnePlaceBecomeOne) {
  Drive known(M_PI, 0.4, test::hallWithBlocks());
  const SlamMemory whole = memoryOf(known);
  // The other robot's frame lies elsewhere.
  SlamMemory moved = whole;
  const Pose2 T_other_map{5.0, -3.0, 2.0};
  for (int k = 0; k < moved.graph.size(); ++k)
    moved.graph.place(k, T_other_map * whole.graph.pose(k));
  Slam slam;
  slam.remember(whole);
  slam.remember(moved);
  slam.finish();
  const SlamMemory merged = slam.memory();
  ASSERT_EQ(merged.graph.size(), 2 * whole.graph.size());
  for (int k = 0; k < whole.graph.size(); ++k) {
    const Eigen::Vector2d apart =
        merged.graph.pose(k).position() - merged.graph.pose(k + whole.graph.size()).position();
    EXPECT_LT(apart.norm(), 0.05) << k;
  }
}

TEST(Slam, AnEmptyMemoryChangesNothing) {
  Drive drive;
  Slam slam(drive.way.front());
  slam.remember({});
  EXPECT_FALSE(slam.step(drive.scans.front(), {}, drive.wheels.front()).is_lost);
  EXPECT_TRUE(slam.isInMemory());
}

TEST(Slam, BadInputNeitherCrashesNorPoisonsThePose) {
  Drive drive;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < 40; ++k) {
    Scan scan = drive.scans[k];
    if (k == 5) scan.ranges.clear();
    if (k == 9) scan.ranges.assign(181, nan);
    if (k == 12) scan.angle_increment = nan;
    if (k == 15) scan.ranges.resize(1);
    std::optional<Pose2> wheels = drive.wheels[k];
    if (k == 20) wheels = Pose2{nan, 0.0, 0.0};
    if (k == 25) wheels.reset();
    const SlamPose pose = slam.step(scan, {}, wheels);
    EXPECT_TRUE(std::isfinite(pose.T_map_robot.x) && std::isfinite(pose.T_map_robot.theta)) << k;
  }
  const auto poses = slam.trajectory();
  ASSERT_EQ(poses.size(), 40u);
  EXPECT_LT((poses.back().position() - drive.way[39].position()).norm(), 0.3);
}

}  // namespace
}  // namespace cca
