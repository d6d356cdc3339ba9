// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_matching.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "walled_plan.hpp"

namespace cca {
namespace {

using test::PlannedWorld;
using test::roomWithNiche;

ScanSurface surfaceAt(PlannedWorld& room, const Pose2& pose, double sigma) {
  return scanSurface(room.world.scan(pose, 360, 2.0 * M_PI, sigma));
}

TEST(MatchPlan, FindsThePoseInARoomFromAFootAside) {
  PlannedWorld room = roomWithNiche();
  const PlanLines plan(room.plan);
  const Pose2 truth{2.5, 2.0, 0.7};
  const ScanSurface surface = surfaceAt(room, truth, 0.0);
  PlanMatching how;
  how.first_reach = 0.6;
  const PlanMatch match = matchPlan(surface, {2.7, 1.8, 0.62}, {}, plan, how);
  EXPECT_NEAR(match.T_map_sensor.x, truth.x, 2e-3);
  EXPECT_NEAR(match.T_map_sensor.y, truth.y, 2e-3);
  EXPECT_NEAR(match.T_map_sensor.theta, truth.theta, 5e-4);
  EXPECT_GT(match.paired, 0.9);
}

TEST(MatchPlan, SaysNothingAlongABareCorridor) {
  PlannedWorld corridor;
  corridor.addWall({-40, 0}, {40, 0});
  corridor.addWall({-40, 2}, {40, 2});
  const PlanLines plan(corridor.plan);
  const ScanSurface surface = surfaceAt(corridor, {0.0, 1.0, 0.1}, 0.01);
  PoseBelief prior;
  prior.mean = {0.3, 1.02, 0.1};
  prior.information.diagonal() << 4.0, 100.0, 400.0;
  const PlanMatch match = matchPlan(surface, prior.mean, prior, plan, {});
  EXPECT_LT(match.information(0, 0), 1.0);
  EXPECT_GT(match.information(1, 1), 1e4);
  EXPECT_NEAR(match.T_map_sensor.x, 0.3, 0.05);  // as the wheels have it
  EXPECT_NEAR(match.T_map_sensor.y, 1.0, 0.01);
  EXPECT_NEAR(match.posterior.inverse()(0, 0), 0.25, 0.05);
}

TEST(MatchPlan, LeavesThePoseWhereNothingIsNear) {
  PlannedWorld room = roomWithNiche();
  const PlanLines plan({{{50.0, 0.0}, {60.0, 0.0}}});
  const Pose2 start{2.5, 2.0, 0.7};
  const PlanMatch match = matchPlan(surfaceAt(room, start, 0.01), start, {}, plan, {});
  EXPECT_EQ(match.paired, 0.0);
  EXPECT_EQ(match.T_map_sensor.x, start.x);
  EXPECT_EQ(match.T_map_sensor.theta, start.theta);
}

TEST(MatchPlan, AShareOfItsInformationMovesThePoseByAsMuchLess) {
  PlannedWorld room = roomWithNiche();
  const PlanLines plan(room.plan);
  const Pose2 truth{2.5, 2.0, 0.7};
  const ScanSurface surface = surfaceAt(room, truth, 0.0);
  PoseBelief prior;
  prior.mean = {2.53, 2.0, 0.7};
  prior.information.diagonal() << 1e4, 1e4, 1e6;
  PlanMatching whole, little;
  little.share = 1e-3;
  const double of_whole = matchPlan(surface, prior.mean, prior, plan, whole).T_map_sensor.x;
  const double of_little = matchPlan(surface, prior.mean, prior, plan, little).T_map_sensor.x;
  EXPECT_LT(std::abs(of_whole - truth.x), std::abs(of_little - truth.x));
  EXPECT_LT(of_little, 2.53);
}

/// The walls of the world, each off its line in the plan.
PlannedWorld roomUnlikeItsPlan(double plan_sigma, test::WalledWorld& dice) {
  const PlannedWorld drawn = roomWithNiche();
  PlannedWorld room;
  room.plan = drawn.plan;
  for (const auto& [a, b] : drawn.plan) {
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector2d off = plan_sigma * dice.noise() * Eigen::Vector2d(-along.y(), along.x());
    room.world.addWall(a + off - 0.2 * along, b + off + 0.2 * along);
  }
  return room;
}

// With hundreds of returns on seven walls the noise of the returns is nothing, that of the walls
// all: who takes returns for independent is off by ten sigmas.
TEST(MatchPlan, ItsCovarianceIsThatOfItsErrorsWhereWallsAreOffThePlan) {
  constexpr double kOff = 0.02;
  constexpr int kRooms = 150;
  test::WalledWorld dice;
  double nees = 0.0;
  for (int k = 0; k < kRooms; ++k) {
    PlannedWorld room = roomUnlikeItsPlan(kOff, dice);
    const PlanLines plan(room.plan);
    const Pose2 truth{2.5 + 0.1 * dice.noise(), 2.5 + 0.1 * dice.noise(), dice.noise()};
    PlanMatching how;
    how.plan_sigma = kOff;
    const PlanMatch match = matchPlan(surfaceAt(room, truth, 0.01), truth, {}, plan, how);
    const Eigen::Vector3d e = difference(match.T_map_sensor, truth);
    nees += e.dot(match.information * e) / kRooms;
  }
  // A wall has several pieces, which are off together here; the mean of chi^2(3) is 3.
  EXPECT_GT(nees, 1.0);
  EXPECT_LT(nees, 9.0);
}

TEST(MatchPlan, LearnsHowFarPiecesAreOff) {
  test::WalledWorld dice;
  double variance = 0.0;
  constexpr int kRooms = 60;
  for (int k = 0; k < kRooms; ++k) {
    PlannedWorld room = roomUnlikeItsPlan(0.02, dice);
    const PlanLines plan(room.plan);
    const Pose2 truth{2.5, 2.5, 0.1 * k};
    variance += matchPlan(surfaceAt(room, truth, 0.01), truth, {}, plan, {}).piece_variance;
  }
  // Less three degrees of freedom of seven walls, which the pose takes up.
  EXPECT_GT(std::sqrt(variance / kRooms), 0.008);
  EXPECT_LT(std::sqrt(variance / kRooms), 0.025);
}

}  // namespace
}  // namespace cca
