// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/scan_period.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

constexpr double kTold = 0.3;  // s, the default of scan_timeout

ScanPeriod periodOf(std::initializer_list<double> stamps) {
  ScanPeriod period;
  for (const double stamp : stamps) period.add(ros::Time(100.0 + stamp));
  return period;
}

TEST(ScanPeriod, IsUnknownUntilThreeScansHaveCome) {
  EXPECT_EQ(ScanPeriod().seconds(), 0.0);
  EXPECT_EQ(periodOf({0.0, 0.18}).seconds(), 0.0);
  EXPECT_NEAR(periodOf({0.0, 0.18, 0.36}).seconds(), 0.18, 1e-9);
  EXPECT_EQ(ScanPeriod().longestSilence(kTold), kTold);
}

TEST(ScanPeriod, PassesOverScansThatAreLostAndStampsThatRepeat) {
  EXPECT_NEAR(periodOf({0.0, 0.1, 0.4, 0.5, 0.9, 1.0, 1.0, 1.1}).seconds(), 0.1, 1e-9);
}

TEST(ScanPeriod, BeginsAnewAfterAClockThatIsSetBack) {
  EXPECT_NEAR(periodOf({50.0, 50.1, 50.2, 0.0, 0.1, 0.2}).seconds(), 0.1, 1e-9);
}

TEST(ScanPeriod, LetsAFastLaserBeSilentForTheTimeThatIsTold) {
  const ScanPeriod ten_hertz = periodOf({0.0, 0.1, 0.2, 0.3});
  EXPECT_EQ(ten_hertz.longestSilence(kTold), kTold);
  EXPECT_NEAR(ten_hertz.oldest(0.5), 0.6, 1e-9);
}

// 5.5 Hz: a scan may be lost, and the watchdog's own period still leaves it within half a second.
TEST(ScanPeriod, LetsASlowLaserLoseOneScan) {
  const double limit = periodOf({0.0, 0.18, 0.37, 0.54, 0.73}).longestSilence(kTold);
  EXPECT_GT(limit, 2.0 * 0.182);
  EXPECT_LT(limit, 0.45);
}

TEST(ScanPeriod, LetsNoRobotDriveBlindForMoreThanAQuarterOfASecond) {
  EXPECT_NEAR(periodOf({0.0, 0.5, 1.0, 1.5}).longestSilence(kTold), 0.75, 1e-9);
  EXPECT_NEAR(periodOf({0.0, 5.0, 10.0, 15.0}).longestSilence(kTold), 1.25, 1e-9);
}

}  // namespace
}  // namespace cca
