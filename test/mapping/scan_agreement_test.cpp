// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/scan_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "cca_mrpt/mapping/line_map.hpp"
#include "segment_world.hpp"

namespace cca {
namespace {

constexpr double kNoise = 0.01;  // m

/// Two rooms of 6 m x 5 m with a door between them, and a way that leads through both and back.
class ScanAgreementOf : public testing::Test {
 protected:
  ScanAgreementOf() {
    world_.box(0.0, 0.0, 12.0, 5.0);
    world_.walls.push_back({{6.0, 0.0}, {6.0, 2.0}});
    world_.walls.push_back({{6.0, 3.0}, {6.0, 5.0}});
  }

  Pose2 truth(int k) const {
    const double u = k / 150.0;  // one turn there and back
    return {6.0 - 4.5 * std::cos(2.0 * M_PI * u), 2.5 + 0.2 * std::sin(4.0 * M_PI * u),
            2.0 * M_PI * u};
  }

  /// Takes 450 scans; believed(k) is where the map puts scan k, spoil(k, scan) what becomes of it.
  template <class Believed, class Spoil>
  ScanAgreement drive(Believed&& believed, Spoil&& spoil) {
    LineMap map;
    ScanAgreement agreement;
    for (int k = 0; k < 450; ++k) {
      Scan scan = world_.scan(truth(k), kNoise, random_, 180);
      scan.T_map_sensor = believed(k);
      spoil(k, scan);
      agreement.add(compareWithMap(scan, map.walls()));
      lowest_ = std::min(lowest_, agreement.recent());
      map.insert(scan);
    }
    return agreement;
  }

  SegmentWorld world_;
  std::mt19937 random_{1};
  double lowest_ = 1.0;
};

const auto kAsItIs = [](int, Scan&) {};

TEST_F(ScanAgreementOf, GoodPosesIsNearlyOne) {
  EXPECT_GT(drive([&](int k) { return truth(k); }, kAsItIs).overall(), kPoorAgreement);
  EXPECT_GT(lowest_, kPoorAgreement);
}

TEST_F(ScanAgreementOf, PosesFiveCentimetresAndADegreeOffIsNearlyOne) {
  std::normal_distribution<double> n(0.0, 0.05);
  std::normal_distribution<double> turn(0.0, M_PI / 180.0);
  const auto noisy = [&](int k) {
    const Pose2 p = truth(k);
    return Pose2{p.x + n(random_), p.y + n(random_), p.theta + turn(random_)};
  };
  drive(noisy, kAsItIs);
  EXPECT_GT(lowest_, kPoorAgreement);
}

TEST_F(ScanAgreementOf, PeopleBeforeTheWallsIsNearlyOne) {
  const auto people = [&](int k, Scan& scan) {
    for (int i = 0; i < 20; ++i) {
      double& range = scan.ranges[static_cast<std::size_t>((2 * k + i) % 180)];
      range = std::min(range, 1.0 + 0.01 * (k % 100));
    }
  };
  drive([&](int k) { return truth(k); }, people);
  EXPECT_GT(lowest_, kPoorAgreement);
}

TEST_F(ScanAgreementOf, DriftingOdometryIsPoor) {
  // 2 degrees a metre: 36 at the end of a lap
  const auto drifting = [&](int k) { return Pose2{0.0, 0.0, 0.0042 * k} * truth(k); };
  drive(drifting, kAsItIs);
  EXPECT_LT(lowest_, kPoorAgreement);
}

TEST_F(ScanAgreementOf, JumpingLocalisationIsPoor) {
  std::uniform_real_distribution<double> jump(-0.7, 0.7);
  Pose2 off;
  const auto jumping = [&](int k) {
    if (k % 50 == 49) off = {jump(random_), jump(random_), 0.3 * jump(random_)};
    return off * truth(k);
  };
  drive(jumping, kAsItIs);
  EXPECT_LT(lowest_, kPoorAgreement);
}

TEST_F(ScanAgreementOf, StampsAheadOfThePosesIsPoor) {
  drive([&](int k) { return truth(k + 5); }, kAsItIs);
  EXPECT_LT(lowest_, kPoorAgreement);
}

TEST(ScanAgreement, WithoutAMapNothingDisagrees) {
  const ScanAgreement none;
  EXPECT_EQ(none.recent(), 1.0);
  EXPECT_EQ(none.overall(), 1.0);
}

TEST(ScanAgreement, WhatNoScanCanBeIsNoVerdict) {
  SegmentWorld world;
  world.box(0.0, 0.0, 6.0, 5.0);
  std::mt19937 random{1};
  LineMap map;
  Scan scan = world.scan({3.0, 2.0, 0.0}, kNoise, random, 180);
  for (int k = 0; k < 20; ++k) map.insert(scan);
  ASSERT_GT(compareWithMap(scan, map.walls()).confirmed, 50);
  const auto verdicts = [&map](const Scan& s) {
    const ScanVerdict v = compareWithMap(s, map.walls());
    return v.confirmed + v.contradicted;
  };
  Scan nowhere = scan;
  nowhere.T_map_sensor.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdicts(nowhere), 0);
  Scan without = scan;
  without.ranges.clear();
  EXPECT_EQ(verdicts(without), 0);
  Scan silent = scan;
  for (double& r : silent.ranges) r = std::numeric_limits<double>::infinity();
  EXPECT_EQ(verdicts(silent), 0);
}

}  // namespace
}  // namespace cca
