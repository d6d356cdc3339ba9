// SPDX-License-Identifier: BSD-3-Clause
#include "slam/surface_matching.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "walled_world.hpp"

namespace cca {
namespace {

class SurfaceMatching : public testing::Test {
 protected:
  SurfaceMatching() {
    world_.addBox(-3.0, -2.0, 4.0, 2.5);
    world_.addBox(1.5, -2.0, 2.2, -1.4);
  }
  test::WalledWorld world_;
};

TEST_F(SurfaceMatching, FindsThePoseOfASecondScan) {
  const Pose2 first{0.1, 0.2, 0.3}, second{0.5, 0.1, 0.5};
  const ScanSurface a = scanSurface(world_.scan(first, 361, M_PI));
  const ScanSurface b = scanSurface(world_.scan(second, 361, M_PI));
  const Pose2 start{0.42, 0.17, 0.55};
  const MatchResult match = matchSurface(b, start, {}, {{&a, first}}, 0.3);
  EXPECT_NEAR(match.T_map_query.x, second.x, 2e-3);
  EXPECT_NEAR(match.T_map_query.y, second.y, 2e-3);
  EXPECT_NEAR(match.T_map_query.theta, second.theta, 1e-3);
  EXPECT_GT(match.paired, 0.7);
}

TEST_F(SurfaceMatching, TurnsWithTheFrameThatAllIsSeenIn) {
  const Pose2 first{0.1, 0.2, 0.3}, second{0.5, 0.1, 0.5}, moved{7.0, -3.0, 2.0};
  const ScanSurface a = scanSurface(world_.scan(first, 181, M_PI));
  const ScanSurface b = scanSurface(world_.scan(second, 181, M_PI));
  const Pose2 start{0.42, 0.17, 0.55};
  const Pose2 here = matchSurface(b, start, {}, {{&a, first}}, 0.3).T_map_query;
  const Pose2 there = matchSurface(b, moved * start, {}, {{&a, moved * first}}, 0.3).T_map_query;
  EXPECT_LT(difference(moved * here, there).norm(), 1e-6);
}

TEST_F(SurfaceMatching, ABareCorridorLeavesItsLengthToThePrior) {
  test::WalledWorld corridor;
  corridor.addWall({-100.0, -1.0}, {100.0, -1.0});
  corridor.addWall({-100.0, 1.0}, {100.0, 1.0});
  const ScanSurface a = scanSurface(corridor.scan({}, 181, M_PI));
  const ScanSurface b = scanSurface(corridor.scan({1.0, 0.1, 0.05}, 181, M_PI));
  PoseBelief prior;
  prior.mean = {1.02, 0.0, 0.0};
  prior.information.diagonal() << 400.0, 400.0, 400.0;
  const MatchResult match = matchSurface(b, prior.mean, prior, {{&a, {}}}, 0.3);
  EXPECT_NEAR(match.T_map_query.x, 1.02, 0.02);
  EXPECT_NEAR(match.T_map_query.y, 0.1, 0.01);
  EXPECT_NEAR(match.T_map_query.theta, 0.05, 0.005);
  EXPECT_GT(match.information(1, 1), 100.0 * match.information(0, 0));
}

TEST_F(SurfaceMatching, EverySecondReturnSaysNearlyWhatAllSay) {
  const Pose2 first{0.1, 0.2, 0.3}, second{0.5, 0.1, 0.5};
  const ScanSurface a = scanSurface(world_.scan(first, 361, M_PI));
  const ScanSurface b = scanSurface(world_.scan(second, 361, M_PI));
  const MatchQuadric all = matchQuadric(b, second, {{&a, first}}, {0.3, 0.05});
  const MatchQuadric half = matchQuadric(b, second, {{&a, first}}, {0.3, 0.05, 2});
  EXPECT_LT((half.H - all.H).norm(), 0.05 * all.H.norm());
  EXPECT_NEAR(half.sum_weights, all.sum_weights, 0.05 * all.sum_weights);
  EXPECT_NEAR(half.paired, all.paired, 0.05 * all.paired);
}

TEST_F(SurfaceMatching, WithoutPartnersThePoseStays) {
  const ScanSurface a = scanSurface(world_.scan({}, 181, M_PI));
  const Pose2 far{500.0, 0.0, 0.0};
  const MatchResult match = matchSurface(a, far, {}, {{&a, {}}}, 0.3);
  EXPECT_EQ(match.paired, 0.0);
  EXPECT_EQ(match.T_map_query.x, far.x);
  const MatchResult empty = matchSurface({}, far, {}, {}, 0.3);
  EXPECT_EQ(empty.T_map_query.x, far.x);
}

TEST_F(SurfaceMatching, RaysOfTheSameRoomAgreeAndThoseOfAShiftedOneDoNot) {
  const Pose2 first{0.1, 0.2, 0.3}, second{0.5, 0.1, 0.5};
  const ScanSurface a = scanSurface(world_.scan(first, 361, M_PI));
  const ScanSurface b = scanSurface(world_.scan(second, 361, M_PI));
  EXPECT_GT(compareSights(a, b, first.inverse() * second).agreement(), 0.99);
  const Pose2 wrong{-0.5, 0.6, 0.5};
  EXPECT_LT(compareSights(a, b, first.inverse() * wrong).agreement(), 0.6);
}

}  // namespace
}  // namespace cca
