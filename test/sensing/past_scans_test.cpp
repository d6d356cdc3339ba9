// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/past_scans.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

constexpr double kTiny = 1e-12;

/// A metre along x, 5 cm a step, the sensor 10 cm ahead of the robot.
PastScans metre() {
  PastScans past;
  for (int k = 0; k <= 20; ++k) {
    const Pose2 T_map_robot{0.05 * k, 0.0, 0.0};
    Scan scan;
    scan.T_map_sensor = T_map_robot * Pose2{0.1, 0.0, 0.0};
    past.add({scan, {}, {}}, T_map_robot);
  }
  return past;
}

TEST(PastScans, KeepAScanEveryTenCentimetresOrFiveDegrees) {
  PastScans past = metre();
  EXPECT_EQ(past.size(), 21u);
  EXPECT_GE(past.kept().size(), 9u);  // 5 cm a step: a sum of steps may lie short of 10 cm by a bit
  EXPECT_LE(past.kept().size(), 11u);
  past.add({}, {1.0, 0.1, 0.0});
  const std::size_t before = past.kept().size();
  past.add({}, {1.0, 0.1, 0.05});
  EXPECT_EQ(past.kept().size(), before);
  past.add({}, {1.0, 0.1, 0.1});
  EXPECT_EQ(past.kept().size(), before + 1);
}

TEST(PastScans, TakeTheirSensorsAlongWhereTheyAreCorrected) {
  PastScans past = metre();
  past.correct(std::vector<Pose2>(past.size(), {3.0, 1.0, M_PI / 2}),
               std::vector<bool>(past.size(), true));
  for (const auto& kept : past.kept()) {
    EXPECT_NEAR(kept.seen.scan.T_map_sensor.x, 3.0, kTiny);
    EXPECT_NEAR(kept.seen.scan.T_map_sensor.y, 1.1, kTiny);
  }
}

TEST(PastScans, ScansOfAnotherLaserGoWithTheirStep) {
  PastScans past;
  for (int k = 0; k <= 20; ++k) {
    const Pose2 T_map_robot{0.05 * k, 0.0, 0.0};
    Scan rear;
    rear.T_map_sensor = T_map_robot * Pose2{-0.1, 0.0, M_PI};
    past.addBeside(past.size(), {rear, {}, {}}, T_map_robot, 1);  // comes first
    past.add({}, T_map_robot);
  }
  EXPECT_EQ(past.size(), 21u);
  EXPECT_EQ(past.kept().size(), 2 * metre().kept().size());
  past.correct(std::vector<Pose2>(21, {3.0, 1.0, M_PI / 2}), std::vector<bool>(21, true));
  for (const auto& kept : past.kept()) {
    if (kept.sensor == 0) continue;
    EXPECT_NEAR(kept.seen.scan.T_map_sensor.y, 0.9, kTiny);
  }
}

TEST(PastScans, MoveAPlaceWithTheScanNearestToIt) {
  PastScans past = metre();
  std::vector<Pose2> corrected;
  for (int k = 0; k <= 20; ++k) corrected.push_back({0.05 * k, k < 10 ? 0.0 : 2.0, 0.0});
  past.correct(corrected, std::vector<bool>(past.size(), true));
  const Eigen::Vector2d near_begin(0.0, 1.0), near_end(1.5, 0.5);
  EXPECT_LT((past.correctionAt(near_begin) * near_begin - near_begin).norm(), kTiny);
  EXPECT_LT((past.correctionAt(near_end) * near_end - Eigen::Vector2d(1.5, 2.5)).norm(), kTiny);
  EXPECT_NEAR(past.correctionHere().y, 2.0, kTiny);
}

TEST(PastScans, APlaceIsNotMovedWithScansThatWereElsewhereThen) {
  PastScans past;
  past.add({}, {0.0, 0.0, 0.0}, false);  // of another frame
  past.add({}, {0.5, 0.0, 0.0});
  past.correct({{7.0, 7.0, 0.0}, {0.5, 1.0, 0.0}}, {true, true});
  const Eigen::Vector2d p(0.0, 0.0);
  EXPECT_LT((past.correctionAt(p) * p - Eigen::Vector2d(0.0, 1.0)).norm(), kTiny);
}

TEST(PastScans, AreNotThoseWhosePlaceIsUnknownUntilItIsKnown) {
  PastScans past = metre();
  const std::size_t placed = past.kept().size();
  past.add({}, {9.0, 9.0, 0.0}, false);
  EXPECT_EQ(past.kept().size(), placed);
  past.correct(std::vector<Pose2>(past.size(), {3.0, 1.0, 0.0}),
               std::vector<bool>(past.size(), true));
  ASSERT_EQ(past.kept().size(), placed + 1);
  EXPECT_EQ(past.kept().back().step, past.size() - 1);
  EXPECT_DOUBLE_EQ(past.kept().back().T_map_robot.x, 3.0);
}

TEST(PastScans, MoveNothingWhereNothingWasKept) {
  PastScans past;
  past.correct({}, {});
  EXPECT_EQ(past.correctionAt({1.0, 2.0}).x, 0.0);
  EXPECT_EQ(past.correctionHere().theta, 0.0);
}

}  // namespace
}  // namespace cca
