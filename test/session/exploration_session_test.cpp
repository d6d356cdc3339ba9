// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/exploration_session.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"

#include <gtest/gtest.h>

#include "../navigation/known_world.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

/// Two rooms with a door, 0.5 m a letter.
const KnownWorld kTwoRooms{{"#############", "#.....#.....#", "#.....#.....#", "#...........#",
                            "#.....#.....#", "#.....#.....#", "#############"},
                           10};

TEST(ExplorationSession, MapsAndExploresTillNothingIsLeft) {
  ExplorationSession session(std::make_unique<GivenPoses>(), {});
  Observation seen;
  seen.T_map_robot = {1.5, 1.7, 0.2};
  Action action;
  for (int k = 0; k < 4000 && action.status != ExplorationStatus::kFinished; ++k) {
    seen.scan = kTwoRooms.scanFrom(seen.T_map_robot, 4.0);
    seen.time = 0.1 * k;
    const Measurement measurement = measurementOf(seen, std::nullopt);
    action = session.decide(session.sense(measurement, seen.velocity));
    seen.velocity = action.velocity;
    const Pose2& T = seen.T_map_robot;
    seen.T_map_robot = T * Pose2{0.1 * action.velocity.linear, 0.0, 0.1 * action.velocity.angular};
  }
  EXPECT_EQ(action.status, ExplorationStatus::kFinished) << action.reason;
  double length = 0.0;
  for (const MapLine& line : session.mapping().lineMap().lines()) length += line.segment.length();
  EXPECT_GT(length, 14.0);  // of 16 m around both rooms and 4 m of faces between them
  EXPECT_EQ(session.mapping().agreement().overall(), 1.0);
}

TEST(ExplorationSession, HandsTheNoiseOfAnAnalysedScanOn) {
  ExplorationSession session(std::make_unique<GivenPoses>(), {});
  Measurement measurement;
  measurement.T_map_robot = Pose2{1.5, 1.7, 0.0};
  measurement.scan = kTwoRooms.scanFrom(*measurement.T_map_robot, 4.0);
  for (std::size_t k = 0; k < measurement.scan.size(); ++k) {
    measurement.scan.ranges[k] += k % 2 ? 0.02 : -0.02;
  }
  const Observation seen = session.sense(measurement, {});
  ASSERT_TRUE(seen.range_sigma);
  EXPECT_GT(*seen.range_sigma, 0.01);
  EXPECT_EQ(*seen.range_sigma, rangeNoise(seen.scan).range_sigma);
}

TEST(ExplorationSession, AScanOfASecondLaserIsMappedAndSeen) {
  ExplorationSession session(std::make_unique<GivenPoses>(), {});
  Measurement measurement;
  measurement.T_map_robot = Pose2{1.5, 1.7, 0.0};
  measurement.scan = kTwoRooms.scanFrom(*measurement.T_map_robot, 4.0);
  measurement.scan.T_map_sensor = *measurement.T_map_robot;
  Measurement blind = measurement;
  blind.scan.ranges.assign(blind.scan.size(), NAN);
  session.decide(session.sense(blind, {}));
  ASSERT_TRUE(session.mapping().lineMap().lines().empty());
  EXPECT_TRUE(session.addSecondary(measurement, 1).is_known);
  EXPECT_GE(session.mapping().lineMap().lines().size(), 3U);
  const ExplorationGrid& grid = session.explorer().grid();
  EXPECT_TRUE(isFree(grid.at(grid.cellOf({2.0, 2.0}))));
}

}  // namespace
}  // namespace cca
