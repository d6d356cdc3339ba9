// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/expectation_maximisation.hpp"

#include <algorithm>
#include <cmath>
#include <random>  // seeded by parameter

namespace cca::baselines {
namespace {

constexpr double kSmallestTurn = 1e-5;    // rad, less is convergence
constexpr double kSmallestWeight = 1e-4;  // less than this and a point has no say
constexpr std::size_t kStartBeams = 5;    // two points of a start are so many beams apart

/// A line and the sum of the weights of the points that stand for it.
struct Supported {
  FittedLine line;
  double support = 0.0;
};

Supported climb(const Pool& pool, const std::vector<std::size_t>& left, FittedLine line,
                const ExpectationMaximisationParameters& p) {
  double support = 0.0;
  for (int iteration = 0; iteration < p.iterations; ++iteration) {
    PointMoments moments;
    for (std::size_t i : left) {
      const double z = distanceFrom(line, pool.points[i]) / p.noise;
      const double weight = std::exp(-0.5 * z * z);
      if (weight > kSmallestWeight) moments.add(pool.points[i], weight);
    }
    if (moments.weight <= 1.0) return {line, 0.0};
    const FittedLine next = fitLine(moments);
    const double turn = 1.0 - std::abs(next.direction.dot(line.direction));
    const double shift = distanceFrom(line, next.centroid);
    line = next;
    support = moments.weight;
    if (turn < 0.5 * kSmallestTurn * kSmallestTurn && shift < 1e-3 * p.noise) break;
  }
  return {line, support};
}

Supported bestLine(const Pool& pool, const std::vector<std::size_t>& left,
                   const ExpectationMaximisationParameters& p, std::mt19937_64& random) {
  Supported best;
  for (int trial = 0; trial < p.trials; ++trial) {
    const std::size_t first = random() % left.size();
    const std::size_t second = std::min(first + kStartBeams, left.size() - 1);
    FittedLine start{};
    start.centroid = pool.points[left[first]];
    const Eigen::Vector2d along = pool.points[left[second]] - start.centroid;
    if (along.norm() <= 0.0) continue;
    start.direction = along.normalized();
    const Supported found = climb(pool, left, start, p);
    if (found.support > best.support) best = found;
  }
  return best;
}

}  // namespace

ExpectationMaximisationParameters ExpectationMaximisationParameters::tuned() {
  return {{0.056, 0.91, {5, 0.14}}, 0.02, 50, 200, 1};
}

std::vector<LineSegment> expectationMaximisation(const Scan& scan,
                                                 const ExpectationMaximisationParameters& p) {
  Pool pool(returnedPoints(scan));
  std::mt19937_64 random(p.seed);
  std::vector<Points> pieces;
  while (true) {
    const std::vector<std::size_t> left = pool.left();
    if (left.size() < static_cast<std::size_t>(std::max(2, p.inliers.limits.min_points))) break;
    const Supported best = bestLine(pool, left, p, random);
    if (best.support <= 0.0) break;
    const auto found = takePieces(pool, best.line, p.inliers);
    pieces.insert(pieces.end(), found.begin(), found.end());
    if (!found.empty()) continue;
    bool any = false;
    for (std::size_t i : left) {
      if (distanceFrom(best.line, pool.points[i]) <= p.inliers.distance) {
        pool.taken[i] = any = true;
      }
    }
    if (!any) break;
  }
  return segmentsOf(pieces);
}

}  // namespace cca::baselines
