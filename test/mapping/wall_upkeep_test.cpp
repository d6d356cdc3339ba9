// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall_upkeep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr int kBins = 40;

/// Hits on bins [first, last) of the wall, on a line that leaves t = 1 m at `slope`; those of
/// neighbouring bins lie `rough` [m] on either side of it.
void hit(Walls& walls, Walls::Slot slot, int first, int last, int times, double slope,
         double rough = 0.0) {
  Wall& wall = walls[slot];
  for (int i = first; i < last; ++i) {
    const double t = (i + 0.5) * SupportProfile::kBinLength;
    const double off = slope * std::max(0.0, t - 1.0) + (i % 2 == 0 ? rough : -rough);
    for (int k = 0; k < times; ++k) wall.profile.hit(t, off);
    wall.hits += times;
  }
  walls.touch(slot);
}

class WallOfTwoMetres : public testing::Test {
 protected:
  /// A straight wall of two metres, of whose second half little was seen yet.
  void SetUp() override {
    slot_ = walls_.create();
    hit(walls_, slot_, 0, kBins / 2, 50, 0.0);
    hit(walls_, slot_, kBins / 2, kBins, 2, 0.0);
    seeToTouched(walls_, noise_, parameters_, next_id_);
    ASSERT_EQ(wallCount(), 1);
  }
  long wallCount() const {
    return std::count_if(walls_.all().begin(), walls_.all().end(),
                         [](const Wall& wall) { return wall.alive; });
  }

  Walls walls_;
  Walls::Slot slot_ = -1;
  MapNoise noise_;
  CcaParameters parameters_;
  std::uint64_t next_id_ = 1;
};

TEST_F(WallOfTwoMetres, IsCutWhenABendPaysHoweverFewHitsShowIt) {
  hit(walls_, slot_, kBins / 2, kBins, 4, 0.4);  // 80 of now 1120 hits
  seeToTouched(walls_, noise_, parameters_, next_id_);
  EXPECT_EQ(wallCount(), 2);
}

TEST_F(WallOfTwoMetres, StaysWholeWhereAVertexIsDearerThanTheBend) {
  parameters_.vertex_price = 100.0;
  hit(walls_, slot_, kBins / 2, kBins, 4, 0.4);
  seeToTouched(walls_, noise_, parameters_, next_id_);
  EXPECT_EQ(wallCount(), 1);
}

TEST_F(WallOfTwoMetres, StaysWholeWhereTheBendIsWithinTheNoise) {
  for (int i = 0; i < 10; ++i) {
    hit(walls_, slot_, kBins / 2, kBins, 4, 0.1);
    seeToTouched(walls_, noise_, parameters_, next_id_);
  }
  EXPECT_EQ(wallCount(), 1);
}

TEST_F(WallOfTwoMetres, KeepsItsFrontWhenAFewReturnsFromBehindAreMergedIntoIt) {
  const Walls::Slot post = walls_.create();
  walls_[post].origin = {1.0, -0.03};
  walls_[post].direction = -Eigen::Vector2d::UnitX();
  hit(walls_, post, 0, 4, 2, 0.0);
  walls_.place(post);
  seeToTouched(walls_, noise_, parameters_, next_id_);
  ASSERT_EQ(wallCount(), 1);
  const Wall& merged = *std::find_if(walls_.all().begin(), walls_.all().end(),
                                     [](const Wall& wall) { return wall.alive; });
  EXPECT_GT(merged.fittedDirection().x(), 0.99);
  EXPECT_FALSE(merged.two_sided);
}

TEST_F(WallOfTwoMetres, IsCutAtABendThatGrowsAfterASearchInVain) {
  hit(walls_, slot_, 0, kBins, 50, 0.0, 0.04);  // a residual that no cut takes away
  seeToTouched(walls_, noise_, parameters_, next_id_);
  ASSERT_EQ(wallCount(), 1);
  ASSERT_GT(walls_[slot_].uncut_residual, walls_[slot_].profile.sums().residual());
  int scans = 0;
  while (wallCount() == 1 && ++scans < 200) {
    hit(walls_, slot_, kBins / 2, kBins, 1, 0.3);
    seeToTouched(walls_, noise_, parameters_, next_id_);
  }
  EXPECT_EQ(wallCount(), 2) << scans;
}

/// Stretches of hits that a wall has; none once another has taken it in.
std::size_t stretchCount(const Wall& wall) {
  return wall.alive ? wall.profile.stretches().size() : 0;
}

TEST(SeeToTouched, OfOneWallThatIsTooLongThePartsDoNotShareALength) {
  // The first 13 m of a wall of 24 m are known when all of it is seen: the returns of every second
  // metre go to the one, all others to the other.
  Walls walls;
  const Walls::Slot shorter = walls.create(), longer = walls.create();
  const int metre = static_cast<int>(std::lround(1.0 / SupportProfile::kBinLength));
  for (int m = -1; m < 24; ++m)
    hit(walls, m < 13 && m % 2 != 0 ? shorter : longer, m * metre, (m + 1) * metre, 5, 0.0);
  std::uint64_t next_id = 1;
  seeToTouched(walls, {}, {}, next_id);
  EXPECT_EQ(stretchCount(walls[shorter]), 1u);  // what lies before the longer
  EXPECT_EQ(stretchCount(walls[longer]), 1u);
}

}  // namespace
}  // namespace cca
