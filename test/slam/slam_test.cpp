// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam.hpp"

#include <gtest/gtest.h>

#include <limits>

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
  test::WalledWorld world = test::ringWithNiches();
  std::vector<Pose2> way, wheels;
  std::vector<Scan> scans;
  explicit Drive(double field_of_view = M_PI, double step = 0.4)
      : way(test::driveAroundRing(step)), wheels(test::wheelsOf(way, world)) {
    for (const Pose2& pose : way) scans.push_back(world.scan(pose, 181, field_of_view, 0.01, 8.0));
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

TEST(Slam, NeedsNoWheelsWhereTheLaserSeesEnough) {
  Drive drive(2.0 * M_PI, 0.1);
  Slam slam(drive.way.front());
  for (std::size_t k = 0; k < drive.way.size(); ++k) slam.step(drive.scans[k], {}, std::nullopt);
  slam.finish();
  EXPECT_LT(worstError(slam.trajectory(), drive.way), 0.3);
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
