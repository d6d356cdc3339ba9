// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/scan_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cca::scan_faults_test {
namespace {

Scan room(double scale = 1.0) {
  Scan scan;
  scan.angle_increment = 2.0 * M_PI / 60.0;
  for (int i = 0; i < 60; ++i) scan.ranges.push_back(scale * (2.0 + 0.01 * i));
  scan.ranges[7] = std::numeric_limits<double>::quiet_NaN();
  scan.ranges[9] = std::numeric_limits<double>::infinity();
  return scan;
}

TEST(ScanFaults, AScanRepeatedWhileTheWheelsGoOnIsNone) {
  ScanFaults faults;
  EXPECT_EQ(faults.check(room(), Pose2{}), ScanFault::kNone);
  EXPECT_EQ(faults.check(room(), Pose2{0.02, 0.0, 0.0}), ScanFault::kNone);
  EXPECT_EQ(faults.check(room(), Pose2{0.06, 0.0, 0.0}), ScanFault::kRepeated);
  EXPECT_EQ(faults.check(room(), Pose2{0.10, 0.0, 0.0}), ScanFault::kRepeated);
  Scan other = room();
  other.ranges[3] += 0.001;
  EXPECT_EQ(faults.check(other, Pose2{0.14, 0.0, 0.0}), ScanFault::kNone);
}

TEST(ScanFaults, ALaserThatRepeatsItselfWhileTheRobotTurnsIsFoundOut) {
  ScanFaults faults;
  EXPECT_EQ(faults.check(room(), Pose2{}), ScanFault::kNone);
  EXPECT_EQ(faults.check(room(), Pose2{0.0, 0.0, 0.1}), ScanFault::kRepeated);
}

TEST(ScanFaults, EqualScansOfARobotThatStandsAreSound) {
  ScanFaults faults;
  for (int k = 0; k < 100; ++k) EXPECT_EQ(faults.check(room(), Pose2{}), ScanFault::kNone);
}

TEST(ScanFaults, WithoutWheelsNothingIsCalledRepeated) {
  ScanFaults faults;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(faults.check(room(), std::nullopt), ScanFault::kNone);
}

TEST(ScanFaults, OpenSpaceAllAroundIsNotRepetition) {
  ScanFaults faults;
  Scan open = room();
  open.ranges.assign(60, std::numeric_limits<double>::infinity());
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(faults.check(open, Pose2{0.1 * k, 0.0, 0.0}), ScanFault::kNone);
  }
}

TEST(ScanFaults, MillimetresAreTold) {
  ScanFaults faults;
  EXPECT_EQ(faults.check(room(1000.0), Pose2{}), ScanFault::kMillimetres);
  EXPECT_EQ(faults.check(room(30.0), Pose2{}), ScanFault::kNone);
}

TEST(ScanFaults, TheMedianReturnLeavesOutWhatIsNone) {
  Scan scan;
  scan.ranges = {0.0, 5.0, std::numeric_limits<double>::infinity(), 1.0, 3.0};
  EXPECT_EQ(medianReturn(scan), 3.0);
  scan.ranges = {0.0};
  EXPECT_EQ(medianReturn(scan), 0.0);
}

}  // namespace
}  // namespace cca::scan_faults_test
