// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/log_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace cca {
namespace {

constexpr double kHalf = 3.0;  // m, half the side of a square room

/// A square room around the origin, seen exactly from several places.
std::vector<Scan> roomScans() {
  std::vector<Scan> scans;
  for (double x = -2.0; x <= 2.0; x += 0.6) {
    Scan scan;
    scan.T_map_sensor = {x, 0.3 * x, 0.1 * x};
    scan.angle_min = -M_PI;
    scan.angle_increment = 2.0 * M_PI / 720;
    for (std::size_t i = 0; i < 720; ++i) {
      const double theta = scan.bearing(i) + scan.T_map_sensor.theta;
      const double c = std::cos(theta), s = std::sin(theta);
      const double to_x = ((c > 0.0 ? kHalf : -kHalf) - scan.T_map_sensor.x) / c;
      const double to_y = ((s > 0.0 ? kHalf : -kHalf) - scan.T_map_sensor.y) / s;
      scan.ranges.push_back(std::min(to_x, to_y));
    }
    scans.push_back(scan);
  }
  return scans;
}

std::vector<Segment2> roomWalls() {
  const Eigen::Vector2d a(-kHalf, -kHalf), b(kHalf, -kHalf), c(kHalf, kHalf), d(-kHalf, kHalf);
  return {{a, b}, {b, c}, {c, d}, {d, a}};
}

TEST(LogScore, GivesATrueMapFullMarks) {
  const LogScore score = scoreAgainstLog(roomScans(), roomWalls());
  EXPECT_NEAR(score.at("map").at("total_length_m"), 8.0 * kHalf, 1e-9);
  EXPECT_DOUBLE_EQ(score.at("points").at("explained_05"), 1.0);
  EXPECT_DOUBLE_EQ(score.at("cells").at("linear_explained_05"), 1.0);
  EXPECT_DOUBLE_EQ(score.at("summary").at("recall_linear_cells_10"), 1.0);
  EXPECT_NEAR(score.at("summary").at("precision_clean_length"), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(score.at("free_space").at("violating_rays_frac"), 0.0);
  EXPECT_DOUBLE_EQ(score.at("redundancy").at("redundant_frac_10"), 0.0);
  EXPECT_LT(score.at("bias").at("rms_m"), 1e-6);
}

TEST(LogScore, MissingWallCostsItsShareOfRecall) {
  auto walls = roomWalls();
  walls.pop_back();
  const LogScore score = scoreAgainstLog(roomScans(), walls);
  EXPECT_NEAR(score.at("summary").at("recall_linear_cells_10"), 0.75, 0.03);
  EXPECT_NEAR(score.at("summary").at("precision_clean_length"), 1.0, 1e-9);
}

TEST(LogScore, WallAcrossFreeSpaceIsPhantomAndContradicted) {
  auto walls = roomWalls();
  walls.push_back({{0.0, -2.0}, {0.0, 2.0}});
  const LogScore score = scoreAgainstLog(roomScans(), walls);
  EXPECT_NEAR(score.at("phantom").at("length_run50_m"), 4.0, 1e-9);
  EXPECT_NEAR(score.at("free_space").at("contradicted_length_m"), 4.0, 0.3);
  EXPECT_NEAR(score.at("summary").at("precision_clean_length"), 24.0 / 28.0, 1e-6);
}

TEST(LogScore, SameWallTwiceCountsOnce) {
  auto walls = roomWalls();
  walls.push_back({{-kHalf, -kHalf + 0.04}, {kHalf, -kHalf + 0.04}});
  const LogScore score = scoreAgainstLog(roomScans(), walls);
  EXPECT_NEAR(score.at("redundancy").at("redundant_frac_05"), 12.0 / 30.0, 0.01);
  EXPECT_NEAR(score.at("redundancy").at("dedup_length_m"), 24.0, 0.2);
  EXPECT_NEAR(score.at("summary").at("precision_clean_length"), 24.0 / 30.0, 0.01);
}

TEST(LogScore, MovedWallShowsAsBiasOfThatSize) {
  auto walls = roomWalls();
  for (auto& wall : walls) {  // 2 cm inwards
    const Eigen::Vector2d inwards = -0.5 * (wall.start + wall.end).normalized();
    wall.start += 0.02 / 0.5 * inwards;
    wall.end += 0.02 / 0.5 * inwards;
  }
  EXPECT_NEAR(scoreAgainstLog(roomScans(), walls).at("bias").at("rms_m"), 0.02, 0.001);
}

TEST(LogScore, WallInPiecesIsJoinable) {
  auto walls = roomWalls();
  const Segment2 whole = walls[0];
  walls[0].end = whole.start + 0.45 * (whole.end - whole.start);
  walls.push_back({whole.start + 0.48 * (whole.end - whole.start), whole.end});
  EXPECT_EQ(scoreAgainstLog(roomScans(), walls).at("redundancy").at("joinable_pairs"), 1.0);
}

TEST(LogScore, EmptyMapHasNoRecallAndNoLength) {
  const LogScore score = scoreAgainstLog(roomScans(), {});
  EXPECT_DOUBLE_EQ(score.at("summary").at("f_score"), 0.0);
  EXPECT_DOUBLE_EQ(score.at("summary").at("mdl_ratio"), 1.0);
  EXPECT_TRUE(std::isnan(score.at("bias").at("rms_m")));
}

TEST(LogScore, PassesOverSegmentsWithoutLengthAndBadRanges) {
  auto scans = roomScans();
  const double inf = std::numeric_limits<double>::infinity();
  scans[0].ranges.insert(scans[0].ranges.end(), {inf, -inf, NAN, 0.0, -1.0, 0.01});
  auto walls = roomWalls();
  walls.push_back({{1.0, 1.0}, {1.0, 1.0}});
  const LogScore score = scoreAgainstLog(scans, walls);
  EXPECT_EQ(score.at("map").at("segments"), 4.0);
  EXPECT_DOUBLE_EQ(score.at("points").at("explained_05"), 1.0);
}

TEST(LogScore, RefusesALogWithoutReturns) {
  EXPECT_THROW(scoreAgainstLog({}, roomWalls()), std::runtime_error);
}

}  // namespace
}  // namespace cca
