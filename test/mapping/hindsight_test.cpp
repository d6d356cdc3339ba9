// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/hindsight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cca_mrpt/mapping/line_extraction.hpp"

namespace cca {
namespace {

const Pose2 kAslant{1.3, -0.7, 0.5};  // of the walls on the map

/// A wall, and 9 cm before it a short line that has a tenth of its returns a metre. The laser is
/// right to 1 cm at 1 m and to 10 cm at 9 m.
class LineBesideAWall : public testing::Test {
 protected:
  void SetUp() override {
    for (int k = 0; k < 100; ++k) {
      noise_.learnRange(1e-4, 1.0);
      noise_.learnRange(0.01, 9.0);
    }
    wall_ = stretch(0.0, 0, 80, 50);
    line_ = stretch(kOff, 20, 32, 5);
    ASSERT_LT(kOff, 3.0 * noise_.lateralSigma()) << "else they do not compete";
  }
  /// Bins [first, last) with so many returns each.
  Walls::Slot stretch(double y, int first, int last, int returns) {
    const Walls::Slot slot = walls_.create();
    walls_[slot].origin = kAslant * Eigen::Vector2d(0.0, y);
    walls_[slot].direction = kAslant.heading();
    for (int i = first; i < last; ++i) {
      const Eigen::Vector2d p((i + 0.5) * SupportProfile::kBinLength, y);
      for (int k = 0; k < returns; ++k) walls_.hit(slot, kAslant * p);
    }
    walls_.place(slot);
    return slot;
  }
  /// Returns of the line's middle 40 cm, from so far away; each fifth beam is lost.
  void lookBackOnLineFrom(double distance) {
    constexpr int kHalf = 20;
    Scan scan;
    scan.T_map_sensor = kAslant * Pose2{1.3, kOff + distance, -M_PI / 2.0};
    scan.angle_min = -std::atan(0.2 / distance);
    scan.angle_increment = -scan.angle_min / kHalf;
    for (std::size_t i = 0; i <= 2 * kHalf; ++i)
      scan.ranges.push_back(i % 5 == 2 ? INFINITY : distance / std::cos(scan.bearing(i)));
    const std::vector<PastScans::Kept> scans{{0, analyse(scan, {}), scan.T_map_sensor}};
    reassignEvidence(scans, noise_, false, walls_);
  }

  static constexpr double kOff = 0.09;
  Walls walls_;
  MapNoise noise_;
  Walls::Slot wall_ = -1, line_ = -1;
};

TEST_F(LineBesideAWall, GoesWhereTheWallMayHaveScatteredItsReturns) {
  lookBackOnLineFrom(9.0);
  EXPECT_FALSE(walls_[line_].alive);
  EXPECT_TRUE(walls_[wall_].alive);
}

TEST_F(LineBesideAWall, StaysWhereTheyWereSeenFromNear) {
  lookBackOnLineFrom(1.0);
  EXPECT_TRUE(walls_[line_].alive);
  EXPECT_TRUE(walls_[wall_].alive);
}

TEST_F(LineBesideAWall, StaysWhereNothingWasSeenOfIt) {
  reassignEvidence({}, noise_, false, walls_);
  EXPECT_TRUE(walls_[line_].alive);
}

}  // namespace
}  // namespace cca
