// SPDX-License-Identifier: BSD-3-Clause
// Line SLAM on small logs of what happens to robots in use: data/field of the shared data.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "cca_mrpt/slam/slam.hpp"
#include "io/poses/local_frame.hpp"

namespace cca {
namespace {

struct Localised {
  std::vector<Pose2> trajectory;
  std::vector<double> times;  // s, from the first scan on
  std::vector<bool> is_placed, is_set_aside;
  std::size_t lost = 0;  // scans after which the robot was lost
};

std::filesystem::path fieldLog(const std::string& name) {
  const char* named = std::getenv("CCA_SHARED_DATA");
  return std::filesystem::path(named != nullptr ? named : CCA_SHARED_DATA_BESIDE) / "field" / name;
}

Localised localise(const std::filesystem::path& path) {
  LocalLog log(openUndistortedLog(path.string()));
  Slam slam;
  Localised localised;
  double begin = 0.0;
  while (const auto record = log.next()) {
    if (localised.times.empty()) begin = record->time;
    localised.times.push_back(record->time - begin);
    slam.step(record->scan, record->T_robot_sensor, record->odometry);
    localised.lost += slam.isLost();
  }
  slam.finish();
  localised.trajectory = slam.trajectory();
  localised.is_placed = slam.isLocalised();
  localised.is_set_aside = slam.isSetAside();
  return localised;
}

TEST(FieldLogs, TheFloorThatANoddingRobotSeesTurnsNothing) {
  const auto path = fieldLog("01_nodding_robot_180deg.log.gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  const Localised drive = localise(path);
  const auto poseAt = [&](double time) {
    const auto at = std::lower_bound(drive.times.begin(), drive.times.end(), time);
    return drive.trajectory[static_cast<std::size_t>(at - drive.times.begin())];
  };
  const Pose2 step = poseAt(84.0).inverse() * poseAt(114.0);
  EXPECT_NEAR(step.x, 12.7, 0.25);  // m; the log's own odometry knows it to .1
  EXPECT_NEAR(step.y, 0.86, 0.1);
  EXPECT_NEAR(step.theta, -2.977, 0.02);
  EXPECT_TRUE(drive.is_set_aside[282]) << "which sees nothing but the floor ahead";
  EXPECT_LT(std::count(drive.is_set_aside.begin(), drive.is_set_aside.end(), true), 12);
}

TEST(FieldLogs, ARobotCarriedInsideItsOwnMapIsFoundThere) {
  const auto path = fieldLog("16_carried_3m.log.gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  const Localised drive = localise(path);
  EXPECT_GT(drive.lost, 0u);
  EXPECT_LE(std::count(drive.is_placed.begin(), drive.is_placed.end(), false), 3);
  // Carried between scans 100 and 101; as the same log cut in two there has it, to 3 mm.
  const Pose2 step = drive.trajectory[100].inverse() * drive.trajectory[101];
  EXPECT_NEAR(step.x, 3.164, 0.02);
  EXPECT_NEAR(step.y, -1.680, 0.02);
  EXPECT_NEAR(step.theta, 0.110, 0.01);
}

}  // namespace
}  // namespace cca
