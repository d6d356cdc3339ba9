// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_extraction.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../sensing/polygon_room.hpp"

namespace cca {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Edges of the room that some line covers by half, within `offset` [m] and `angle` [rad].
int edgesFound(const PolygonRoom& room, const std::vector<LineSegment>& lines, double offset,
               double angle = 5.0 * M_PI / 180.0) {
  int found = 0;
  for (std::size_t k = 0; k < room.vertices.size(); ++k) {
    const Eigen::Vector2d a = room.vertices[k], b = room.vertices[(k + 1) % room.vertices.size()];
    const Eigen::Vector2d u = (b - a).normalized();
    found += std::any_of(lines.begin(), lines.end(), [&](const LineSegment& l) {
      const Eigen::Vector2d middle = 0.5 * (l.start + l.end), v = l.direction();
      const Eigen::Vector2d off = middle - a;
      return std::abs(u.x() * v.y() - u.y() * v.x()) < std::sin(angle) &&
             std::abs(u.x() * off.y() - u.y() * off.x()) < offset &&
             l.length() > 0.5 * (b - a).norm();
    });
  }
  return found;
}

void expectSame(const std::vector<LineSegment>& a, const std::vector<LineSegment>& b,
                const Pose2& T_b_a, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (const LineSegment& line : a) {
    EXPECT_TRUE(std::any_of(b.begin(), b.end(), [&](const LineSegment& other) {
      return (T_b_a * line.start - other.start).norm() < tolerance &&
             (T_b_a * line.end - other.end).norm() < tolerance;
    }));
  }
}

TEST(ExtractLines, FindsTheSingleWallInView) {
  Scan scan;
  scan.angle_min = -0.5;
  scan.angle_increment = 0.01;
  for (std::size_t i = 0; i < 100; ++i) scan.ranges.push_back(2.0 / std::cos(scan.bearing(i)));
  const auto lines = extractLines(scan);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].start.x(), 2.0, 1e-6);
  EXPECT_NEAR(lines[0].end.x(), 2.0, 1e-6);
  EXPECT_NEAR(lines[0].length(), 2.0 * (std::tan(0.5) + std::tan(0.49)), 1e-6);
  EXPECT_DOUBLE_EQ(lines[0].moments.weight, 100.0);
}

TEST(ExtractLines, RecoversBothWallsOfARightAngleAndTheirCorner) {
  std::mt19937 random(1);
  const auto lines =
      extractLines(scanOf(rectangle(-9.0, -9.0, 2.0, 2.0), 0.2, 0.01, 118, 0.01, &random));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].end, lines[1].start);
  EXPECT_NEAR((lines[0].end - Eigen::Vector2d(2.0, 2.0)).norm(), 0.0, 0.02);
}

TEST(ExtractLines, ClosesTheFourWallsOfARoomWhereverTheScanBegins) {
  std::mt19937 random(2);
  const PolygonRoom room = rectangle(-2.0, -1.0, 3.0, 2.5);
  for (double first = -3.0; first < 3.0; first += 0.37) {
    const auto lines = extractLines(turnIn(room, 0.02, &random, first));
    ASSERT_EQ(lines.size(), 4u) << first;
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d corner = lines[k].end;
      EXPECT_TRUE(std::any_of(room.vertices.begin(), room.vertices.end(),
                              [&](const auto& v) { return (v - corner).norm() < 0.05; }));
      EXPECT_EQ(lines[k].end, lines[(k + 1) % 4].start);
    }
  }
}

TEST(ExtractLines, JoinsTheEndsOfATurnOf361Beams) {
  std::mt19937 random(3);
  const PolygonRoom room = rectangle(-2.0, -1.0, 3.0, 2.5);
  for (const double increment : {2.0 * M_PI / 360.0, 2.0 * M_PI / 361.0}) {
    const auto lines = extractLines(scanOf(room, -M_PI, increment, 361, 0.02, &random));
    EXPECT_EQ(lines.size(), 4u);
  }
}

TEST(ExtractLines, TurnWithTheScan) {
  std::mt19937 random(4);
  const Scan scan = turnIn(rectangle(-2.0, -1.0, 3.0, 2.5), 0.03, &random);
  for (const double turn : {0.1, 1.0, 2.5}) {
    Scan turned = scan;
    turned.angle_min += turn;
    expectSame(extractLines(scan), extractLines(turned), {0.0, 0.0, turn}, 1e-6);
  }
}

TEST(ExtractLines, AreTheSameFromAClockwiseScan) {
  std::mt19937 random(5);
  const Scan scan = scanOf(rectangle(-2.0, -1.0, 3.0, 2.5), -1.5, 0.01, 300, 0.03, &random);
  Scan clockwise = scan;
  std::reverse(clockwise.ranges.begin(), clockwise.ranges.end());
  clockwise.angle_min = scan.bearing(299);
  clockwise.angle_increment = -0.01;
  expectSame(extractLines(scan), extractLines(clockwise), {}, 1e-6);
}

TEST(ExtractLines, GiveTheSameBytesAgain) {
  std::mt19937 random(6);
  const Scan scan = turnIn(rectangle(-2.0, -1.0, 3.0, 2.5), 0.05, &random);
  const auto a = extractLines(scan), b = extractLines(scan);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].start, b[k].start);
    EXPECT_EQ(a[k].covariance, b[k].covariance);
  }
}

TEST(ExtractLines, GrowWithTheScaleWhileNoiseAndDetailDo) {
  std::mt19937 random(7);
  const PolygonRoom room = rectangle(-2.0, -1.0, 3.0, 2.5);
  const Scan scan = turnIn(room, 0.05, &random);  // above the straightness of walls
  Scan larger = scan;
  for (double& range : larger.ranges) range *= 3.0;
  const auto a = extractLines(scan), b = extractLines(larger);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(edgesFound(room, a, 0.1), 4);
}

TEST(ExtractLines, LoseWallsOnlySlowlyAsTheNoiseGrows) {
  PolygonRoom room = {
      {{-3, -2}, {0, -2.5}, {3, -2}, {4, 0}, {3, 2.5}, {0.5, 2}, {-1, 3}, {-3.5, 1}}};
  double before = 1.0;
  for (const double sigma : {0.0, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3}) {
    std::mt19937 random(8);
    double recall = 0.0, per_edge = 0.0;
    // An edge of 40 returns and 3 m has an orientation good to sigma / (sqrt(40) 0.9 m).
    const double angle = 5.0 * M_PI / 180.0 + 3.0 * sigma / (std::sqrt(40.0) * 0.9);
    for (int k = 0; k < 20; ++k) {
      const auto lines = extractLines(turnIn(room, sigma, &random));
      recall += edgesFound(room, lines, 0.05 + sigma, angle) / 8.0 / 20.0;
      per_edge += static_cast<double>(lines.size()) / 8.0 / 20.0;
    }
    EXPECT_GT(recall, before - 0.2) << sigma;  // no cliff between neighbouring noises
    EXPECT_GT(recall, sigma <= 0.15 ? 0.9 : 0.7) << sigma;
    EXPECT_LT(per_edge, 1.1) << sigma;  // noise makes no lines
    before = recall;
  }
}

TEST(ExtractLines, JoinAWallBehindWhatHidesIt) {
  Scan scan;
  scan.angle_min = -0.8;
  scan.angle_increment = 0.01;
  for (std::size_t i = 0; i < 161; ++i) {
    const double c = std::cos(scan.bearing(i));
    scan.ranges.push_back(i > 74 && i < 86 ? 1.0 / c : 3.0 / c);  // 0.36 m hidden
  }
  const auto lines = extractLines(scan);
  ASSERT_EQ(lines.size(), 2u);
  const double longest = std::max(lines[0].length(), lines[1].length());
  EXPECT_NEAR(longest, 6.0 * std::tan(0.8), 0.01);
}

TEST(ExtractLines, LeaveApartWhereADoorwayMayBeHidden) {
  Scan scan;
  scan.angle_min = -0.8;
  scan.angle_increment = 0.01;
  for (std::size_t i = 0; i < 161; ++i) {
    const double c = std::cos(scan.bearing(i));
    scan.ranges.push_back(i > 70 && i < 90 ? 1.0 / c : 3.0 / c);  // 0.6 m hidden
  }
  EXPECT_EQ(extractLines(scan).size(), 3u);
}

TEST(ExtractLines, ShareABluntCornerThatNoiseMovesAcrossABeam) {
  std::mt19937 random(12);
  const PolygonRoom room{{{-9, -9}, {9, -9}, {4.0, -2.0}, {3.0, 2.0}, {0.2, 6.1}, {-9, 9}}};
  const int trials = 200;
  int lines_alone = 0, shared = 0;
  for (int k = 0; k < trials; ++k) {
    const auto lines = extractLines(scanOf(room, 0.1, 0.01, 95, 0.03, &random));
    if (lines.size() != 2u) continue;
    ++lines_alone;
    shared += lines[0].end == lines[1].start;
  }
  EXPECT_GT(lines_alone, 0.95 * trials);
  EXPECT_GT(shared, 0.85 * lines_alone);  // at 20 degrees noise moves a corner by 2 to 3 beams
}

TEST(ExtractLines, LeaveADoorOpenThroughWhichRaysPass) {
  Scan scan;
  scan.angle_min = -0.8;
  scan.angle_increment = 0.01;
  for (std::size_t i = 0; i < 161; ++i) {
    const double c = std::cos(scan.bearing(i));
    scan.ranges.push_back(i > 60 && i < 90 ? 6.0 / c : 3.0 / c);
  }
  for (const LineSegment& line : extractLines(scan)) {
    if (line.start.x() < 4.0) {
      EXPECT_LT(line.length(), 3.5);
    }
  }
  for (std::size_t i = 61; i < 90; ++i) scan.ranges[i] = kInf;
  for (const LineSegment& line : extractLines(scan)) EXPECT_LT(line.length(), 3.5);
}

TEST(ExtractLines, HaveTheCovarianceThatTheirErrorsHave) {
  const int trials = 400;
  const double sigma = 0.06;  // above the straightness of walls
  double lateral = 0.0, angular = 0.0;
  int whole = 0;
  std::mt19937 random(9);
  for (int k = 0; k < trials; ++k) {
    const auto lines =
        extractLines(scanOf(rectangle(-9, -9, 2, 9), -0.5, 0.01, 101, sigma, &random));
    if (lines.size() != 1u) continue;
    ++whole;
    const Eigen::Vector2d u = lines[0].direction();
    const double offset = lines[0].moments.mean.x() - 2.0, angle = std::atan2(u.x(), u.y());
    lateral += offset * offset / lines[0].covariance(0, 0);
    angular += angle * angle / lines[0].covariance(1, 1);
  }
  EXPECT_GT(whole, 0.97 * trials);  // a line price of 17 nats lets noise bend a wall that rarely
  // 400 squares have a mean good to 7 %, and sigma is itself estimated from 100 beams.
  EXPECT_NEAR(lateral / whole, 1.0, 0.25);
  EXPECT_NEAR(angular / whole, 1.0, 0.3);
}

TEST(ExtractLines, GiveNothingForScansWithoutReturns) {
  Scan scan;
  EXPECT_TRUE(extractLines(scan).empty());
  scan.angle_increment = 0.01;
  for (const double range : {kInf, std::nan(""), 0.0, -1.0, 1e300}) {
    scan.ranges.assign(50, range);
    EXPECT_TRUE(extractLines(scan).empty());
  }
  for (int beams = 0; beams < 3; ++beams) {
    scan.ranges.assign(static_cast<std::size_t>(beams), 1.0);
    EXPECT_TRUE(extractLines(scan).empty());
  }
}

TEST(ExtractLines, FindThreePointsOfAWall) {
  Scan scan;
  scan.angle_min = -0.2;
  scan.angle_increment = 0.2;
  for (std::size_t i = 0; i < 3; ++i) scan.ranges.push_back(0.4 / std::cos(scan.bearing(i)));
  EXPECT_EQ(extractLines(scan).size(), 1u);
}

TEST(ExtractLines, FindTheWallsAmongInvalidReadings) {
  std::mt19937 random(10);
  const PolygonRoom room = rectangle(-2.0, -1.0, 3.0, 2.5);
  Scan scan = turnIn(room, 0.02, &random);
  for (std::size_t i = 5; i < scan.size(); i += 17) {
    scan.ranges[i] = i % 2 == 0 ? std::nan("") : -1.0;
  }
  EXPECT_EQ(edgesFound(room, extractLines(scan), 0.05), 4);
}

TEST(ExtractLines, ManageTenThousandBeams) {
  std::mt19937 random(11);
  const PolygonRoom room = rectangle(-2.0, -1.0, 3.0, 2.5);
  const auto lines = extractLines(scanOf(room, -M_PI, 2.0 * M_PI / 10000.0, 10000, 0.02, &random));
  EXPECT_EQ(edgesFound(room, lines, 0.05), 4);
  EXPECT_EQ(lines.size(), 4u);
}

TEST(ExtractLines, LeaveOutOfAWallWhatIsWithinItsStraightness) {
  // A cupboard a metre wide stands 3 cm out of a wall that is seen head on.
  const PolygonRoom room{
      {{-3, -3}, {-0.5, -3}, {-0.5, -2.97}, {0.5, -2.97}, {0.5, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  std::mt19937 random(14);
  const Scan scan = scanOf(room, -2.2, 0.01, 126, 0.003, &random);
  CcaParameters parameters;
  EXPECT_EQ(extractLines(scan, parameters).size(), 1u);
  parameters.straightness = 0.005;
  EXPECT_EQ(extractLines(scan, parameters).size(), 3u);
  parameters.vertex_price = 100.0;
  EXPECT_LT(extractLines(scan, parameters).size(), 3u);
}

TEST(ExtractLines, SurviveAnyRangesAndStayFinite) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double odd[] = {std::nan(""), kInf, -kInf, -1.0, 0.0, 1e-300, 1e300, 1e-9, 2.0};
  int lines = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Scan scan;
    const int beams = trial % 90;
    scan.angle_min = -4.0 + 8.0 * uniform(random);
    scan.angle_increment = (trial % 3 == 0 ? -1.0 : 1.0) * 6.4 / (1.0 + beams) * uniform(random);
    double range = 1.0;
    for (int i = 0; i < beams; ++i) {
      range *= 0.9 + 0.2 * uniform(random);
      scan.ranges.push_back(uniform(random) < 0.2 ? odd[random() % 9] : range);
    }
    CcaParameters parameters;
    parameters.similarity_cut = 0.01 + 0.99 * uniform(random);
    parameters.vertex_price = 1.0 + 50.0 * uniform(random);
    parameters.straightness = 0.1 * uniform(random);
    for (const LineSegment& line : extractLines(scan, parameters)) {
      EXPECT_TRUE(line.start.allFinite() && line.end.allFinite() && line.covariance.allFinite());
      EXPECT_GT(line.length(), 0.0);
      EXPECT_GE(line.moments.weight, 3.0);
      ++lines;
    }
  }
  EXPECT_GT(lines, 200);  // some are found all the same
}

}  // namespace
}  // namespace cca
