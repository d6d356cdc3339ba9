// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/corner_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../sensing/polygon_room.hpp"
#include "mapping/line_merging.hpp"

namespace cca::corner_refinement_test {
namespace {

double price(const Runs& runs) {
  double sum = 0.0;
  for (const FittedRun& run : runs) sum += run.price;
  return sum;
}

/// The shortest telling there is, by dynamic programming over all partings: O(N^2) fits.
double shortestTelling(const RunFitter& fitter, int n) {
  std::vector<double> least(n + 1, 0.0);
  for (int j = 1; j <= n; ++j) {
    least[j] = least[j - 1] + kPointPrice;
    for (int i = 0; i < j; ++i) least[j] = std::min(least[j], least[i] + fitter.price(i, j));
  }
  return least[n];
}

struct Corner {
  ScanPoints points;
  PointNoise noise{0.03, 0.001, 0.0};
  RunFitter fitter{points.positions, noise};

  explicit Corner(unsigned seed) {
    std::mt19937 random(seed);
    points = scanPoints(scanOf(rectangle(-5.0, -5.0, 3.0, 3.0), 0.3, 0.01, 100, 0.03, &random));
    fitter = RunFitter(points.positions, noise);
  }
};

TEST(RefineCorners, MovesABoundaryToTheCorner) {
  const Corner corner(1);
  for (const int wrong : {40, 45, 52, 56}) {
    Runs runs = {corner.fitter.fit(0, wrong), corner.fitter.fit(wrong, 100)};
    while (refineCorners(corner.points, corner.fitter, &runs)) {
    }
    ASSERT_EQ(runs.size(), 2u) << wrong;
    EXPECT_NEAR(runs[0].last, (M_PI / 4.0 - 0.3) / 0.01, 3.0);
  }
}

TEST(RefineCorners, SplitsALineThatRunsThroughACorner) {
  const Corner corner(2);
  Runs runs = {corner.fitter.fit(0, 100)};
  while (refineCorners(corner.points, corner.fitter, &runs)) {
  }
  EXPECT_EQ(runs.size(), 2u);
}

TEST(RefineCorners, FindsTheLineAmongLoosePoints) {
  const Corner corner(3);
  Runs runs;
  for (int i = 0; i < 8; ++i) runs.push_back(corner.fitter.fit(i, i + 1));
  EXPECT_TRUE(refineCorners(corner.points, corner.fitter, &runs));
  EXPECT_EQ(runs.size(), 1u);
  EXPECT_TRUE(runs[0].is_line);
}

TEST(RefineCorners, NeverLengthensTheTellingAndEnds) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Corner corner(seed);
    Runs runs;
    const int step = 3 + static_cast<int>(seed);
    for (int i = 0; i < 100; i += step) {
      runs.push_back(corner.fitter.fit(i, std::min(100, i + step)));
    }
    double before = price(runs);
    int rounds = 0;
    while (refineCorners(corner.points, corner.fitter, &runs)) {
      EXPECT_LE(price(runs), before + 1e-9);
      before = price(runs);
      ASSERT_LT(++rounds, 100);
      int next = 0;
      for (const FittedRun& run : runs) {
        EXPECT_EQ(run.first, next);
        next = run.last;
      }
      EXPECT_EQ(next, 100);
    }
  }
}

TEST(RefineCorners, WithMergingComesCloseToTheShortestTellingThereIs) {
  double excess = 0.0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Corner corner(seed);
    Runs runs;
    for (int i = 0; i < 100; i += 5) runs.push_back(corner.fitter.fit(i, i + 5));
    for (bool changed = true; changed;) {
      changed = false;
      while (mergeConsecutive(corner.points, corner.fitter, 0.5, &runs)) changed = true;
      if (refineCorners(corner.points, corner.fitter, &runs)) changed = true;
    }
    const double least = shortestTelling(corner.fitter, 100);
    EXPECT_GE(price(runs), least - 1e-6);
    excess += price(runs) - least;
  }
  EXPECT_LT(excess / 10.0, 0.1 * linePrice(CcaParameters().vertex_price));
}

TEST(MeetAtCorners, MovesABoundaryBackToWhereTheLinesMeet) {
  const int truth = static_cast<int>(std::ceil((M_PI / 4.0 - 0.3) / 0.01));
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Corner corner(seed);
    for (const int off : {-2, -1, 0, 1, 2}) {
      Runs runs = {corner.fitter.fit(0, truth + off), corner.fitter.fit(truth + off, 100)};
      meetAtCorners(corner.points, corner.fitter, &runs);
      ASSERT_EQ(runs.size(), 2u);
      EXPECT_EQ(runs[0].last, runs[1].first);
      const auto vertex = intersection(runs[0].line, runs[1].line);
      ASSERT_TRUE(vertex);
      const double bearing = std::atan2(vertex->y(), vertex->x());
      EXPECT_GE(bearing, 0.3 + 0.01 * (runs[0].last - 1)) << seed << " " << off;
      EXPECT_LE(bearing, 0.3 + 0.01 * runs[1].first) << seed << " " << off;
    }
  }
}

TEST(MeetAtCorners, LeavesLinesThatDoNotMeet) {
  // Two parallel walls with a step between them, and a wall told in two halves.
  std::mt19937 random(5);
  const PolygonRoom step{
      {{-5.0, -5.0}, {2.0, -5.0}, {2.0, 0.0}, {4.0, 0.0}, {4.0, 5.0}, {-5.0, 5.0}}};
  const ScanPoints points = scanPoints(scanOf(step, -0.5, 0.01, 100, 0.01, &random));
  const RunFitter fitter(points.positions, PointNoise{0.01, 0.001, 0.0});
  for (const int boundary : {25, 50}) {
    Runs runs = {fitter.fit(0, boundary), fitter.fit(boundary, 50), fitter.fit(50, 100)};
    if (boundary == 50) runs.erase(runs.begin() + 1);
    const Runs before = runs;
    meetAtCorners(points, fitter, &runs);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      EXPECT_EQ(runs[k].first, before[k].first);
      EXPECT_EQ(runs[k].last, before[k].last);
    }
  }
}

/// Beams 0 to 11 see a wall at x = 4, the last twelve one at x = far, and two the edge that joins
/// the first to one at x = 6.
Runs steepEdge(double far, ScanPoints* points, RunFitter* fitter) {
  const PolygonRoom room{
      {{4.0, -2.0}, {4.0, 0.12}, {6.0, 0.42}, {6.0, 3.0}, {-2.0, 3.0}, {-2.0, -2.0}}};
  Scan scan = scanOf(room, -0.2, 0.02, 26, 0.0, nullptr);
  for (std::size_t i = 14; i < 26; ++i) scan.ranges[i] = far / std::cos(scan.bearing(i));
  *points = scanPoints(scan);
  const PointNoise noise{0.01, 0.001, 0.0};
  *fitter = RunFitter(points->positions, noise);
  return {fitter->fit(0, 12), fitter->fit(12, 14), fitter->fit(14, 26)};
}

TEST(TellEdgesBetween, FindsASteepEdgeBetweenTwoWalls) {
  ScanPoints points;
  RunFitter fitter({}, {});
  Runs runs = steepEdge(6.0, &points, &fitter);
  ASSERT_FALSE(runs[1].is_line);
  tellEdgesBetween(points, fitter, &runs);
  EXPECT_TRUE(runs[1].is_line);
}

TEST(TellEdgesBetween, FindsAnEdgeThatItsNeighboursHaveTakenOver) {
  const PolygonRoom room{
      {{4.0, -2.0}, {4.0, 0.12}, {4.25, 0.36}, {4.25, 3.0}, {-2.0, 3.0}, {-2.0, -2.0}}};
  const ScanPoints points = scanPoints(scanOf(room, -0.2, 0.02, 26, 0.0, nullptr));
  const RunFitter fitter(points.positions, PointNoise{0.02, 0.001, 0.0});
  for (const int boundary : {12, 13, 14, 15}) {
    Runs runs = {fitter.fit(0, boundary), fitter.fit(boundary, 26)};
    ASSERT_TRUE(runs[0].is_line && runs[1].is_line);
    tellEdgesBetween(points, fitter, &runs);
    ASSERT_EQ(runs.size(), 3u) << boundary;
    EXPECT_TRUE(runs[1].is_line);
    EXPECT_EQ(runs[0].last, 12);
    EXPECT_EQ(runs[1].first, 12);
    EXPECT_EQ(runs[1].last, 15);
    EXPECT_EQ(runs[2].first, 15);
  }
}

TEST(TellEdgesBetween, AddsNoneWhereTwoWallsMeet) {
  int added = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Corner corner(seed);
    Runs runs = {corner.fitter.fit(0, 50), corner.fitter.fit(50, 100)};
    while (refineCorners(corner.points, corner.fitter, &runs)) {
    }
    const std::size_t before = runs.size();
    tellEdgesBetween(corner.points, corner.fitter, &runs);
    added += static_cast<int>(runs.size() - before);
  }
  // At one in 22 000 and some fifty places a corner, one in 400.
  EXPECT_LE(added, 2);
}

TEST(TellEdgesBetween, LeavesTwoPointsWhoseLineMissesAWall) {
  ScanPoints points;
  RunFitter fitter({}, {});
  for (const double far : {5.0, 7.5}) {
    Runs runs = steepEdge(far, &points, &fitter);
    tellEdgesBetween(points, fitter, &runs);
    EXPECT_FALSE(runs[1].is_line) << far;
  }
}

}  // namespace
}  // namespace cca::corner_refinement_test
