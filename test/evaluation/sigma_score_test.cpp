// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/sigma_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

const std::vector<Segment2> kWall{{{0.0, 0.0}, {4.0, 0.0}}};

MapLine line(double offset, double angle, double sigma_offset, double sigma_angle) {
  MapLine line;
  const Eigen::Vector2d half(2.0 * std::cos(angle), 2.0 * std::sin(angle)), middle(2.0, offset);
  line.segment.start = middle - half;
  line.segment.end = middle + half;
  line.segment.covariance << sigma_offset * sigma_offset, 0.0, 0.0, sigma_angle * sigma_angle;
  return line;
}

TEST(SigmaScore, ErrorsAreToldInDeviations) {
  const ScoreGroup score =
      scoreSigmas(kWall, {line(0.02, 0.001, 0.01, 0.002), line(-0.01, -0.004, 0.01, 0.002),
                          line(0.04, 0.008, 0.01, 0.002)});
  EXPECT_EQ(score.at("lines"), 3.0);
  EXPECT_NEAR(score.at("offset_median"), 2.0, 1e-9);
  EXPECT_NEAR(score.at("angle_median"), 2.0, 1e-6);
  EXPECT_NEAR(score.at("offset_beyond_3"), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(score.at("angle_beyond_3"), 1.0 / 3.0, 1e-9);
}

TEST(SigmaScore, LineTheOtherWayRoundErrsAsMuch) {
  MapLine back = line(0.02, 0.004, 0.01, 0.002);
  std::swap(back.segment.start, back.segment.end);
  EXPECT_NEAR(scoreSigmas(kWall, {back}).at("angle_median"), 2.0, 1e-6);
}

TEST(SigmaScore, LinesWithoutWallOrVarianceAreNotAsked) {
  const ScoreGroup score =
      scoreSigmas(kWall, {line(0.5, 0.0, 0.01, 0.01), line(0.0, 0.0, 0.0, 0.0)});
  EXPECT_EQ(score.at("lines"), 0.0);
  EXPECT_TRUE(std::isnan(score.at("offset_median")));
}

}  // namespace
}  // namespace cca
