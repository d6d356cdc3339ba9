// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_sight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cca {
namespace {

SightShares seenBy(const SightRay& ray) {
  const PlanLines plan({{{2.0, -5.0}, {2.0, 5.0}}});
  return seePlan({ray}, {}, plan, 0.1);
}

TEST(SeePlan, TellsWhatABeamSaysOfAWallBeforeIt) {
  EXPECT_EQ(seenBy({{2.05, 0.3}}).explained, 1.0);
  EXPECT_EQ(seenBy({{1.2, 0.3}}).hidden, 1.0);
  EXPECT_EQ(seenBy({{3.0, 0.3}}).through, 1.0);
}

TEST(SeePlan, AReturnThatFacesAsideIsNotExplainedByTheWall) {
  EXPECT_EQ(seenBy({{2.0, 0.3}, {-1.0, 0.0}}).explained, 1.0);
  EXPECT_EQ(seenBy({{2.0, 0.3}, {0.0, 1.0}}).hidden, 1.0);
}

TEST(SeePlan, ABeamWithoutReturnSpeaksOnlyWhereItWentThroughAWall) {
  SightRay silent{{1.5, 0.3}};
  silent.is_return = false;
  EXPECT_EQ(seenBy(silent).count(), 0.0);
  silent.end.x() = 4.0;
  EXPECT_EQ(seenBy(silent).through, 1.0);
}

/// What a return says behind the wall of a room, with another room behind it.
SightShares seenBehind(const Eigen::Vector2d& end, const Eigen::Vector2d& normal) {
  const double turn = 0.4;
  const auto turned = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(std::cos(turn) * p.x() - std::sin(turn) * p.y(),
                           std::sin(turn) * p.x() + std::cos(turn) * p.y());
  };
  std::vector<PlanLine> lines;
  for (const double x : {-3.6, 1.0, 5.2}) {
    lines.push_back({turned({x, -5.0}), turned({x, 5.0})});
  }
  return seePlan({{turned(end), turned(normal)}}, {}, PlanLines(lines), 0.1);
}

TEST(SeePlan, AReturnThroughAPaneIsOfTheWallBehind) {
  EXPECT_EQ(seenBehind({5.25, 0.3}, {-1.0, 0.0}).beyond, 1.0);
  EXPECT_EQ(seenBehind({5.25, 0.3}, {0.0, 1.0}).through, 1.0) << "of another surface";
  EXPECT_EQ(seenBehind({3.9, 0.3}, {-1.0, 0.0}).through, 1.0) << "of none";
}

TEST(SeePlan, AReturnInAMirrorIsOfTheWallBefore) {
  EXPECT_EQ(seenBehind({5.62, 0.3}, {-1.0, 0.0}).beyond, 1.0);
  EXPECT_EQ(seenBehind({5.62, 0.3}, {0.0, 1.0}).through, 1.0);
}

SightShares shares(double explained, double hidden, double through) {
  return {explained, hidden, through, 0.0, 0.0};
}

TEST(SightModel, FurnitureAndPeopleSpeakAgainstNoPoseAndRaysThroughWallsDo) {
  const SightModel model;
  EXPECT_GT(model.evidence(shares(60, 40, 0)), 0.0);
  EXPECT_GT(model.evidence(shares(20, 80, 0)), 0.0);
  EXPECT_LT(model.evidence(shares(40, 30, 30)), 0.0);
  EXPECT_EQ(model.evidence(shares(0, 0, 0)), 0.0);
}

TEST(SightModel, LearnsWhatIsUsual) {
  SightModel model;
  for (int k = 0; k < 200; ++k) model.learn(shares(20, 80, 0), 0.1);
  EXPECT_NEAR(model.usual().explained, 0.2, 0.02);
  EXPECT_NEAR(model.usual().hidden, 0.8, 0.02);
  // Hidden beams are usual here now, and speak for the pose.
  EXPECT_GT(model.evidence(shares(0, 10, 0)), SightModel().evidence(shares(0, 10, 0)));
}

TEST(SightModel, PanesSpeakAgainstAPlaceUntilTheyAreUsual) {
  SightShares panes = shares(50, 30, 0);
  panes.beyond = 20.0;
  SightModel model;
  const double before = model.evidence(panes);
  EXPECT_LT(before, model.evidence(shares(50, 30, 0)));
  EXPECT_GT(before, model.evidence(shares(50, 30, 20)));
  for (int k = 0; k < 200; ++k) model.learn(panes, 0.1);
  EXPECT_GT(model.evidence(panes), before);
}

TEST(SightModel, AnExactFitIsWorthMoreThanACloseOne) {
  const SightModel model;
  SightShares exact = shares(10, 0, 0), close = exact;
  exact.distance_sq = 10 * 0.01 * 0.01;
  close.distance_sq = 10 * 0.08 * 0.08;
  EXPECT_GT(model.evidence(exact, 0.03, 0.1), model.evidence(close, 0.03, 0.1));
}

}  // namespace
}  // namespace cca
