// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/ransac.hpp"

#include <random>  // seeded by parameter

namespace cca::baselines {
namespace {

/// The best of the lines drawn; weight in `support` is the number of points near it.
FittedLine drawLine(const Pool& pool, const std::vector<std::size_t>& left,
                    const RansacParameters& p, std::mt19937_64& random, int& support) {
  FittedLine best{};
  support = 0;
  for (int trial = 0; trial < p.trials; ++trial) {
    const Eigen::Vector2d a = pool.points[left[random() % left.size()]];
    const Eigen::Vector2d b = pool.points[left[random() % left.size()]];
    const double length = (b - a).norm();
    if (length <= 0.0) continue;
    FittedLine line;
    line.centroid = a;
    line.direction = (b - a) / length;
    int votes = 0;
    for (std::size_t i : left) votes += distanceFrom(line, pool.points[i]) <= p.inliers.distance;
    if (votes > support) support = votes, best = line;
  }
  return best;
}

}  // namespace

RansacParameters RansacParameters::tuned() { return {{0.056, 0.91, {5, 0.14}}, 340, 1}; }

std::vector<LineSegment> ransac(const Scan& scan, const RansacParameters& p) {
  Pool pool(returnedPoints(scan));
  std::mt19937_64 random(p.seed);
  std::vector<Points> pieces;
  while (true) {
    const std::vector<std::size_t> left = pool.left();
    if (left.size() < static_cast<std::size_t>(p.inliers.limits.min_points)) break;
    int support = 0;
    const FittedLine line = drawLine(pool, left, p, random, support);
    if (support < p.inliers.limits.min_points) break;
    const auto found = takePieces(pool, line, p.inliers);
    pieces.insert(pieces.end(), found.begin(), found.end());
    if (!found.empty()) continue;
    // A line through scattered points: set them aside, or it would be drawn again.
    for (std::size_t i : left) {
      if (distanceFrom(line, pool.points[i]) <= p.inliers.distance) pool.taken[i] = true;
    }
  }
  return segmentsOf(pieces);
}

}  // namespace cca::baselines
