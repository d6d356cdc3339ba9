// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/walls.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace cca {
namespace {

constexpr double kBin = SupportProfile::kBinLength;

class PlaceThatWasFreed : public testing::Test {
 protected:
  /// Two returns at kPlace that many rays refuted.
  void SetUp() override {
    const Walls::Slot slot = wallAt(kPlace.y());
    for (int k = 0; k < 2; ++k) walls_.hit(slot, kPlace);
    walls_[slot].profile.pass(kPlace.x(), 9.0);
    ASSERT_FALSE(walls_.prune(slot));
    walls_.remove(slot);
    walls_.recycle();
  }
  /// A wall along x.
  Walls::Slot wallAt(double y) {
    const Walls::Slot slot = walls_.create();
    walls_[slot].origin = {0.0, y};
    return slot;
  }
  /// The same with returns on each bin before x = 1 m.
  Walls::Slot standingWallAt(double y, int returns) {
    const Walls::Slot slot = wallAt(y);
    for (int i = 0; i < 20; ++i) {
      for (int k = 0; k < returns; ++k) walls_.hit(slot, {(i + 0.5) * kBin, y});
    }
    walls_.place(slot);
    return slot;
  }
  /// Rays that speak against the first return of a wall at y.
  double raysAgainstNewcomer(double y) {
    const Walls::Slot slot = wallAt(y);
    const Eigen::Vector2d p(kPlace.x(), y);
    walls_.hit(slot, p);
    return walls_[slot].profile.bin(SupportProfile::binOf(p.x())).passed;
  }

  const Eigen::Vector2d kPlace{0.52, 0.1};
  Walls walls_;
};

TEST_F(PlaceThatWasFreed, SpeaksAgainstWhatIsNewThereAndNowhereElse) {
  EXPECT_EQ(raysAgainstNewcomer(kPlace.y()), 4.0);
  EXPECT_EQ(raysAgainstNewcomer(0.5), 0.0);
}

TEST_F(PlaceThatWasFreed, SpeaksOnceAgainstEachBin) {
  const Walls::Slot slot = wallAt(kPlace.y());
  for (int k = 0; k < 5; ++k) walls_.hit(slot, kPlace);
  EXPECT_EQ(walls_[slot].profile.bin(SupportProfile::binOf(kPlace.x())).passed, 4.0);
}

TEST_F(PlaceThatWasFreed, DoesNotSpeakAgainstWhatLiesBesideAWallThatStands) {
  standingWallAt(kPlace.y() + 0.04, 10);
  EXPECT_EQ(raysAgainstNewcomer(kPlace.y()), 0.0);
}

TEST_F(PlaceThatWasFreed, SpeaksAgainstWhatLiesBesideAWallThatDoesNotStandYet) {
  standingWallAt(kPlace.y() + 0.04, 1);
  EXPECT_EQ(raysAgainstNewcomer(kPlace.y()), 4.0);
}

TEST_F(PlaceThatWasFreed, SpeaksAgainstWhatLiesFurtherOffThanWhatIsMerged) {
  standingWallAt(kPlace.y() + 0.15, 10);
  EXPECT_EQ(raysAgainstNewcomer(kPlace.y()), 4.0);
}

TEST(FreedPlaces, AreToldApartAcrossTheWholeMap) {
  Walls walls;
  const auto wallAt = [&](const Eigen::Vector2d& p) {
    const Walls::Slot slot = walls.create();
    walls[slot].origin = p;
    walls.hit(slot, p);
    return slot;
  };
  const auto isFreed = [&](double x, double y) {
    return walls[wallAt({x, y})].profile.bin(0).passed > 0.0;
  };
  const double far = 9.9e6;  // m
  EXPECT_FALSE(isFreed(far, -0.1));
  for (const double x : {far, 1.0}) {
    const Walls::Slot slot = wallAt({x, -0.1});
    walls[slot].profile.pass(0.01, 9.0);
    ASSERT_FALSE(walls.prune(slot));
  }
  EXPECT_TRUE(isFreed(far, -0.1));
  EXPECT_TRUE(isFreed(1.1, -0.15));
  for (const auto& [x, y] : {std::pair{far, 0.1},
                             {-far, -0.1},
                             {far - 0.4, -0.1},
                             {-0.1, far},
                             {1.0, 0.1},
                             {-1.0, -0.1},
                             {1.3, -0.1},
                             {1.0, -0.4}})
    EXPECT_FALSE(isFreed(x, y)) << x << ", " << y;
}

/// A wall of one metre and, beside it, what a few of its returns have founded.
class WallAndWhatItScattered : public testing::Test {
 protected:
  void SetUp() override {
    for (int k = 0; k < 100; ++k) {
      noise_.learnRange(1e-4, 1.0);
      noise_.learnRange(0.01, 9.0);
    }
    wall_ = at(0.0, 100);
    scattered_ = at(0.15, 2);
  }
  Walls::Slot at(double y, int returns_per_bin) {
    const Walls::Slot slot = walls_.create();
    walls_[slot].origin = {0.0, y};
    for (int i = 0; i < 20; ++i) {
      for (int k = 0; k < returns_per_bin; ++k) walls_.hit(slot, {(i + 0.5) * kBin, y});
    }
    walls_.place(slot);
    return slot;
  }
  /// Of a return at (0.52, y) that was seen from so far away.
  Walls::Slot likelyHitBy(double y, double range) const {
    return walls_.likelyHitBy({0.52, y}, {0.52, y + range}, noise_);
  }

  Walls walls_;
  MapNoise noise_;
  Walls::Slot wall_ = -1, scattered_ = -1;
};

TEST_F(WallAndWhatItScattered, HasTheReturnsThatMayHaveMissedItByTheirOwnNoise) {
  EXPECT_EQ(likelyHitBy(0.15, 9.0), wall_);
  EXPECT_EQ(likelyHitBy(-0.25, 9.0), wall_);
}

TEST_F(WallAndWhatItScattered, HasNoneThatANearLaserWouldNotScatterSoFar) {
  EXPECT_EQ(likelyHitBy(0.15, 1.0), scattered_);
  EXPECT_EQ(likelyHitBy(0.0, 1.0), wall_);
  EXPECT_EQ(likelyHitBy(-0.25, 1.0), -1);
}

TEST_F(WallAndWhatItScattered, SharesTheReturnsByTheirDistanceWhereBothHaveAsMany) {
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 98; ++k) walls_.hit(scattered_, {(i + 0.5) * kBin, 0.15});
  }
  EXPECT_EQ(likelyHitBy(0.1, 9.0), scattered_);
  EXPECT_EQ(likelyHitBy(0.05, 9.0), wall_);
}

}  // namespace
}  // namespace cca
