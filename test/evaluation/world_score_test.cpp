// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/world_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace cca {
namespace {

const std::vector<Segment2> kTruth{{{0.0, 0.0}, {4.0, 0.0}}, {{4.0, 0.0}, {4.0, 2.0}}};

TEST(WorldScore, GivesTheTruthFullMarks) {
  const ScoreGroup score = scoreAgainstWorld(kTruth, kTruth).at("world");
  EXPECT_DOUBLE_EQ(score.at("precision"), 1.0);
  EXPECT_DOUBLE_EQ(score.at("recall"), 1.0);
  EXPECT_DOUBLE_EQ(score.at("f1"), 1.0);
  EXPECT_DOUBLE_EQ(score.at("lateral_rms_m"), 0.0);
  EXPECT_DOUBLE_EQ(score.at("end_error_median_m"), 0.0);
  EXPECT_DOUBLE_EQ(score.at("vertices_found"), 1.0);
}

TEST(WorldScore, MeasuresOffsetAndAngle) {
  const Segment2 shifted{{0.0, 0.03}, {4.0, 0.03}};
  EXPECT_NEAR(scoreAgainstWorld(kTruth, {shifted}).at("world").at("lateral_rms_m"), 0.03, 1e-9);
  const double turn = 1.0 * M_PI / 180.0;
  const Segment2 turned{{0.0, 0.0}, {4.0 * std::cos(turn), 4.0 * std::sin(turn)}};
  EXPECT_NEAR(scoreAgainstWorld(kTruth, {turned}).at("world").at("angle_mean_deg"), 1.0, 1e-9);
}

TEST(WorldScore, MissingLengthCostsRecallAndFalseLengthCostsPrecision) {
  const ScoreGroup half = scoreAgainstWorld(kTruth, {kTruth[1]}).at("world");
  EXPECT_NEAR(half.at("recall"), 2.0 / 6.0, 0.02);
  EXPECT_DOUBLE_EQ(half.at("precision"), 1.0);
  auto more = kTruth;
  more.push_back({{0.0, 1.0}, {3.0, 1.0}});
  EXPECT_NEAR(scoreAgainstWorld(kTruth, more).at("world").at("precision"), 6.0 / 9.0, 1e-9);
}

TEST(WorldScore, LengthAtTheWrongAngleIsFalse) {
  EXPECT_LT(scoreAgainstWorld(kTruth, {{{2.0, -0.1}, {2.0, 0.1}}}).at("world").at("recall"), 1e-9);
}

TEST(WorldScore, DuplicateCountsOnce) {
  const ScoreGroup score = scoreAgainstWorld(kTruth, {kTruth[0], kTruth[0]}).at("world");
  EXPECT_DOUBLE_EQ(score.at("precision"), 0.5);
  EXPECT_DOUBLE_EQ(score.at("redundant"), 1.0);
}

TEST(WorldScore, BothFacesOfAThinWallAreNoDuplicates) {
  const std::vector<Segment2> thin{{{0.0, 0.0}, {4.0, 0.0}}, {{4.0, 0.08}, {0.0, 0.08}}};
  ScoreGroup score = scoreAgainstWorld(thin, thin).at("world");
  EXPECT_DOUBLE_EQ(score.at("precision"), 1.0);
  EXPECT_DOUBLE_EQ(score.at("redundant"), 0.0);
  score = scoreAgainstWorld(thin, {thin[0], thin[1], thin[1]}).at("world");
  EXPECT_NEAR(score.at("precision"), 2.0 / 3.0, 1e-9);
  EXPECT_DOUBLE_EQ(score.at("redundant"), 1.0);
}

TEST(WorldScore, EmptyMapHasNoRecall) {
  const ScoreGroup score = scoreAgainstWorld(kTruth, {}).at("world");
  EXPECT_DOUBLE_EQ(score.at("recall"), 0.0);
  EXPECT_DOUBLE_EQ(score.at("f1"), 0.0);
  EXPECT_TRUE(std::isnan(score.at("precision")));
  EXPECT_THROW(scoreAgainstWorld({}, kTruth), std::runtime_error);
}

}  // namespace
}  // namespace cca
