// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/k_means.hpp"

#include <gtest/gtest.h>

#include <random>

#include "polygon_room.hpp"

namespace cca {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// Lloyd's algorithm as it is written: every point against every centroid.
std::vector<int> fullLloyd(const Points& points, Points centroids, int sweeps) {
  std::vector<int> cluster(points.size(), -1);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool moved = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      int best = 0;
      for (std::size_t k = 1; k < centroids.size(); ++k) {
        if ((points[i] - centroids[k]).squaredNorm() <
            (points[i] - centroids[best]).squaredNorm()) {
          best = static_cast<int>(k);
        }
      }
      moved = moved || best != cluster[i];
      cluster[i] = best;
    }
    if (!moved) break;
    for (std::size_t k = 0; k < centroids.size(); ++k) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      int count = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (cluster[i] != static_cast<int>(k)) continue;
        sum += points[i];
        ++count;
      }
      if (count > 0) centroids[k] = sum / count;
    }
  }
  return cluster;
}

Points evenSeeds(const Points& points, int k) {
  Points seeds;
  for (int i = 0; i < k; ++i) {
    seeds.push_back(points[static_cast<std::size_t>((i + 0.5) * points.size() / k)]);
  }
  return seeds;
}

TEST(KMeansInOrder, EqualsFullLloydOnTheSameSeedsInRooms) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Scan scan = turnIn(rectangle(-1.0 - trial % 5, -2.0, 5.0, 0.5 + trial % 3), 0.03, &random);
    for (std::size_t i = 40; i < 90; ++i) scan.ranges[i] *= 0.4;  // something stands in the room
    const ScanPoints points = scanPoints(scan);
    for (const int k : {1, 7, 40, 72, 180}) {
      EXPECT_EQ(kMeansInOrder(points, k, 20),
                fullLloyd(points.positions, evenSeeds(points.positions, k), 20));
    }
  }
}

TEST(KMeansInOrder, EqualsFullLloydWhereDepthAlternatesFromBeamToBeam) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> range(0.5, 8.0);
  Scan scan;
  scan.angle_min = -2.0;
  scan.angle_increment = 4.0 / 200.0;
  for (int i = 0; i < 200; ++i) scan.ranges.push_back(range(random));
  const ScanPoints points = scanPoints(scan);
  for (const int k : {3, 40, 100}) {
    EXPECT_EQ(kMeansInOrder(points, k, 20),
              fullLloyd(points.positions, evenSeeds(points.positions, k), 20));
  }
}

}  // namespace
}  // namespace cca
