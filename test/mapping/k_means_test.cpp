// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/k_means.hpp"

#include <gtest/gtest.h>

#include <random>

#include "../sensing/polygon_room.hpp"
#include "mapping/point_clusters.hpp"

namespace cca {
namespace {

struct ClusteredRoom {
  ScanPoints points;
  PointNoise noise{0.03, 0.001, 0.0};
  RunFitter fitter{points.positions, noise};
  Runs shares;

  ClusteredRoom(unsigned seed, bool with_a_crate) {
    std::mt19937 random(seed);
    Scan scan = turnIn(rectangle(-1.0 - seed % 5, -2.0, 5.0, 0.5 + seed % 3), 0.03, &random);
    for (std::size_t i = 40; with_a_crate && i < 90; ++i) scan.ranges[i] *= 0.4;
    points = scanPoints(scan, 0.03);
    fitter = RunFitter(points.positions, noise);
    shares = pointClusters(points, fitter, Ablation(Part::kKMeans));
  }
};

double price(const Runs& runs) {
  double sum = 0.0;
  for (const FittedRun& run : runs) sum += run.price;
  return sum;
}

TEST(KMeans, EndsWhereNoBoundaryTellsMoreBrieflyElsewhere) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ClusteredRoom room(seed, true);
    Runs runs = room.shares;
    ASSERT_TRUE(kMeans(room.points, room.fitter, &runs)) << seed;
    EXPECT_LT(price(runs), price(room.shares)) << seed;
    for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
      const FittedRun &a = runs[k], &b = runs[k + 1];
      ASSERT_EQ(a.last, b.first);
      if (!areNeighbours(room.points, a, b) || (!a.is_line && !b.is_line)) continue;
      for (int move = -kBoundaryReach; move <= kBoundaryReach; ++move) {
        const int middle = a.last + move;
        if (middle < a.first || middle > b.last) continue;
        const double moved = room.fitter.price(a.first, middle) + room.fitter.price(middle, b.last);
        EXPECT_GE(moved, a.price + b.price - 2.0 * kNoGain) << seed << ", boundary at " << a.last;
      }
    }
    EXPECT_FALSE(kMeans(room.points, room.fitter, &runs)) << seed;
  }
}

TEST(KMeans, LetsNoPointCrossAStepInDepth) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ClusteredRoom room(seed, true);
    Runs runs = room.shares;
    kMeans(room.points, room.fitter, &runs);
    for (const FittedRun& run : runs) {
      EXPECT_EQ(room.points.breaksBetween(run.first, run.last - 1), 0) << seed;
    }
  }
}

TEST(KMeans, BringsABoundaryToTheCornerFromAfar) {
  constexpr double kFirst = 0.3, kSpacing = 0.01;  // rad; the corner lies at pi / 4
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const PolygonRoom walls = rectangle(-5.0, -5.0, 3.0, 3.0);
    const ScanPoints points = scanPoints(scanOf(walls, kFirst, kSpacing, 100, 0.03, &random), 0.03);
    const RunFitter fitter(points.positions, {0.03, 0.001, 0.0});
    for (const int wrong : {35, 42, 55, 62}) {
      Runs runs = {fitter.fit(0, wrong), fitter.fit(wrong, 100)};
      EXPECT_TRUE(kMeans(points, fitter, &runs));
      ASSERT_EQ(runs.size(), 2U) << seed;
      EXPECT_NEAR(runs[0].last, (M_PI / 4.0 - kFirst) / kSpacing, 4.0) << seed << ", " << wrong;
    }
  }
}

TEST(TwoMeans, AreTheBestOfAllPartings) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ClusteredRoom room(seed, true);
    for (int first = 0; first + 30 <= 360; first += 15) {
      double least = room.fitter.price(first, first + 30);
      int best = -1;
      for (int middle = first + 1; middle < first + 30; ++middle) {
        const double parted =
            room.fitter.price(first, middle) + room.fitter.price(middle, first + 30);
        if (parted >= least - kNoGain) continue;
        least = parted;
        best = middle;
      }
      EXPECT_EQ(twoMeans(room.fitter, first, first + 1, first + 29, first + 30,
                         room.fitter.price(first, first + 30) - kNoGain),
                best);
    }
  }
}

TEST(KMeans, OfNothingAndOfOneClusterMovesNothing) {
  const ClusteredRoom room(1, false);
  Runs none, one{room.fitter.fit(0, 30)};
  EXPECT_FALSE(kMeans(room.points, room.fitter, &none));
  EXPECT_FALSE(kMeans(room.points, room.fitter, &one));
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(one.size(), 1U);
}

}  // namespace
}  // namespace cca
