// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/scan_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace cca {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Fan {
  int beams;
  double first_deg, field_of_view_deg;  // negative: clockwise
};

Scan scanOf(const Fan& fan) {
  Scan scan;
  scan.angle_min = fan.first_deg * M_PI / 180.0;
  scan.angle_increment = fan.field_of_view_deg * M_PI / 180.0 / (fan.beams - 1);
  scan.free_range_without_return = 30.0;
  for (int i = 0; i < fan.beams; ++i) scan.ranges.push_back(1.0 + 0.01 * i);
  return scan;
}

sensor_msgs::LaserScan messageOf(const std::vector<float>& ranges) {
  sensor_msgs::LaserScan message;
  message.angle_min = -1.0f;
  message.angle_increment = 0.1f;
  message.range_min = 0.1f;
  message.range_max = 10.0f;
  message.ranges = ranges;
  return message;
}

class EveryFan : public testing::TestWithParam<Fan> {};

TEST_P(EveryFan, ComesBackFromAMessageWithEachRayWhereItWas) {
  const Scan scan = scanOf(GetParam());
  const LaserLimits limits{0.0, 30.0, 0.1, 0.0};
  const Scan back = scanFromMessage(scanToMessage(scan, limits, {}));
  ASSERT_EQ(back.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_EQ(back.ranges[i], static_cast<float>(scan.ranges[i]));
    // 32 bits: half a unit in the last place of the increment, times the beams.
    EXPECT_NEAR(back.bearing(i), scan.bearing(i), 1e-6);
  }
  EXPECT_EQ(back.free_range_without_return, 30.0);
}

// The first four are those that MRPT's bridge shifts by one ray, the fifth it turns by 173 degrees.
INSTANTIATE_TEST_SUITE_P(OfCommonLasers, EveryFan,
                         testing::Values(Fan{181, -90, 180}, Fan{360, -180, 359},
                                         Fan{361, -90, 180}, Fan{1081, -180, 360}, Fan{100, 10, 77},
                                         Fan{1081, -135, 270}, Fan{541, 135, -270},
                                         Fan{2, -10, 20}));

TEST(ScanMessage, EqualMessagesComeBackFromAScan) {
  auto message = messageOf({0.5f, 1.5f, std::numeric_limits<float>::infinity()});
  message.header.frame_id = "laser";
  message.header.stamp = ros::Time(12, 34);
  message.angle_max = message.angle_min + 2 * message.angle_increment;
  message.scan_time = 0.025f;
  message.time_increment = 1e-5f;
  const LaserLimits limits{message.range_min, message.range_max, message.scan_time,
                           message.time_increment};
  const auto back = scanToMessage(scanFromMessage(message), limits, message.header);
  EXPECT_EQ(back.ranges, message.ranges);
  EXPECT_EQ(back.angle_min, message.angle_min);
  EXPECT_NEAR(back.angle_max, message.angle_max, 1e-6);
  EXPECT_EQ(back.angle_increment, message.angle_increment);
  EXPECT_EQ(back.range_min, message.range_min);
  EXPECT_EQ(back.range_max, message.range_max);
  EXPECT_EQ(back.scan_time, message.scan_time);
  EXPECT_EQ(back.time_increment, message.time_increment);
  EXPECT_EQ(back.header.frame_id, "laser");
  EXPECT_EQ(back.header.stamp, ros::Time(12, 34));
}

TEST(ScanMessage, RangesReadAsRep117HasIt) {
  const float inf = std::numeric_limits<float>::infinity();
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  const Scan scan =
      scanFromMessage(messageOf({inf, -inf, nan, 0.0f, -1.0f, 0.05f, 0.1f, 5.0f, 10.0f, 10.5f}));
  for (const int missing : {0, 9}) EXPECT_TRUE(isNoReturn(scan.ranges[missing]));
  for (const int invalid : {1, 2, 3, 4, 5}) EXPECT_TRUE(std::isnan(scan.ranges[invalid]));
  for (const int valid : {6, 7, 8}) EXPECT_TRUE(isReturn(scan.ranges[valid]));
}

TEST(ScanMessage, NoReturnIsInfinityAndInvalidIsNaN) {
  Scan scan;
  scan.angle_increment = 0.1;
  scan.ranges = {kInf, kNaN, -kInf, 0.0, -2.0, 3.0};
  const auto message = scanToMessage(scan, {0.0, 8.0, 0.1, 0.0}, {});
  EXPECT_TRUE(std::isinf(message.ranges[0]) && message.ranges[0] > 0);
  for (const int invalid : {1, 2, 3, 4}) EXPECT_TRUE(std::isnan(message.ranges[invalid]));
  EXPECT_EQ(message.ranges[5], 3.0f);
}

TEST(ScanMessage, WithoutBeamsItIsAScanWithoutBeams) {
  const Scan scan = scanFromMessage(messageOf({}));
  EXPECT_EQ(scan.size(), 0u);
  EXPECT_EQ(seeingFraction(scan), 0.0);
  EXPECT_EQ(scanToMessage(scan, {0.0, 8.0, 0.1, 0.0}, {}).ranges.size(), 0u);
}

TEST(ScanMessage, WhatNoLaserCanHaveMeantIsRefused) {
  const auto refused = [](auto&& spoil) {
    auto message = messageOf({1.0f, 2.0f, 3.0f});
    spoil(message);
    EXPECT_THROW(scanFromMessage(message), std::runtime_error);
  };
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  refused([&](auto& m) { m.angle_min = nan; });
  refused([&](auto& m) { m.angle_increment = nan; });
  refused([&](auto& m) { m.angle_increment = 0.0f; });
  refused([&](auto& m) { m.angle_increment = 4.0f; });
  refused([&](auto& m) { m.range_max = 0.0f; });
  refused([&](auto& m) { m.range_max = nan; });
  refused([&](auto& m) { m.time_increment = nan; });
}

std::string faultOf(const sensor_msgs::LaserScan& message) {
  try {
    scanFromMessage(message);
  } catch (const MalformedScan& fault) {
    return fault.what();
  }
  return "";
}

TEST(ScanMessage, ARefusalTellsTheRuleAndTheValuesThatBreakIt) {
  auto message = messageOf({1.0f, 2.0f, 3.0f});
  message.range_max = 0.0f;
  EXPECT_EQ(faultOf(message),
            "range_max must be positive and above range_min (range_max 0, range_min 0.1)");
  message = messageOf(std::vector<float>(11, 1.0f));
  message.angle_min = 1.0f;
  message.angle_max = -1.0f;
  EXPECT_EQ(faultOf(message),
            "ranges and angle_increment must lead from angle_min to angle_max (11 beams of "
            "angle_increment 0.1 lead from angle_min 1 to 2, not to angle_max -1)");
}

// range_max in the same unit, or not; some beams without return.
TEST(ScanMessage, RangesInMillimetresAreRefusedAsSuch) {
  const float inf = std::numeric_limits<float>::infinity();
  auto message = messageOf({1410.0f, 1345.0f, inf, 900.0f, 350.0f, 5200.0f});
  for (const float range_max : {12.0f, 12000.0f}) {
    message.range_max = range_max;
    EXPECT_THAT(faultOf(message), testing::HasSubstr("they look like millimetres"));
  }
}

TEST(ScanMessage, ANumberThatStandsForNoReturnIsNoMillimetre) {
  for (const float no_return : {65533.0f, 3.4e38f}) {
    auto message = messageOf({2.0f, no_return, no_return, no_return, 3.0f, no_return});
    EXPECT_EQ(faultOf(message), "");
    message.ranges = {no_return, no_return};
    EXPECT_EQ(faultOf(message), "");
  }
}

TEST(ScanMessage, TheFirstOfSeveralEchoesIsTheRange) {
  sensor_msgs::MultiEchoLaserScan message;
  message.header.frame_id = "laser";
  message.angle_increment = 0.1f;
  message.range_min = 0.1f;
  message.range_max = 10.0f;
  message.ranges.resize(3);
  message.ranges[0].echoes = {2.0f, 5.0f};
  message.ranges[2].echoes = {std::numeric_limits<float>::infinity()};
  const sensor_msgs::LaserScan first = firstEchoes(message);
  EXPECT_EQ(first.header.frame_id, "laser");
  const Scan scan = scanFromMessage(first);
  EXPECT_EQ(scan.ranges[0], 2.0);
  EXPECT_TRUE(std::isnan(scan.ranges[1]));
  EXPECT_TRUE(isNoReturn(scan.ranges[2]));
  EXPECT_EQ(scan.free_range_without_return, 10.0);
}

TEST(ScanMessage, TheMiddleOfTheSweepLiesHalfwayThroughItsBeams) {
  auto message = messageOf(std::vector<float>(101, 1.0f));
  message.header.stamp = ros::Time(100.0);
  message.time_increment = 0.001f;
  EXPECT_NEAR(sweepMiddle(message).toSec(), 100.05, 1e-6);
  message.time_increment = 0.0f;
  EXPECT_EQ(sweepMiddle(message), message.header.stamp);
}

TEST(ScanMessage, SeeingCountsReturnsAndMissingReturns) {
  Scan scan;
  scan.ranges = {1.0, kInf, kNaN, -kInf};
  EXPECT_DOUBLE_EQ(seeingFraction(scan), 0.5);
}

}  // namespace
}  // namespace cca
