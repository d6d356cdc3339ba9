// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <queue>
#include <random>

#include "box_world.hpp"

namespace cca::testing {

/// A random world with a start and a goal in it.
struct Query {
  BoxWorld world;
  double width = 12.0, height = 12.0;
  Pose2 start;
  Eigen::Vector2d goal;
};

enum class Verdict { kReachable, kUnreachable, kUndecided };

/// Where the truth is taken for decided. A way that is free for a disc of radius `wide` (m) to
/// within `near` (m) of the goal must be found; one that is not free for a disc of radius `narrow`
/// cannot be.
struct Band {
  double narrow, wide, near;
};

/// The truth: a breadth-first search over the true configuration space.
class TrueConfigurationSpace {
 public:
  static constexpr double kCell = 0.02;  // m

  explicit TrueConfigurationSpace(const Query& query)
      : query_(query),
        columns_(static_cast<int>(query.width / kCell)),
        rows_(static_cast<int>(query.height / kCell)),
        clearance_(static_cast<std::size_t>(columns_ * rows_)) {
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < columns_; ++c)
        clearance_[index(c, r)] = query.world.clearance(center(c, r));
    }
  }

  /// Whether the goal's neighbourhood of `tolerance` can be reached by a disc of this radius.
  bool reaches(double radius, double tolerance) const {
    std::vector<bool> seen(clearance_.size(), false);
    std::queue<std::pair<int, int>> open;
    const auto visit = [&](int c, int r) {
      if (c < 0 || r < 0 || c >= columns_ || r >= rows_ || seen[index(c, r)]) return;
      if (clearance_[index(c, r)] < radius) return;
      seen[index(c, r)] = true;
      open.push({c, r});
    };
    visit(static_cast<int>(query_.start.x / kCell), static_cast<int>(query_.start.y / kCell));
    while (!open.empty()) {
      const auto [c, r] = open.front();
      open.pop();
      if ((center(c, r) - query_.goal).norm() <= tolerance) return true;
      visit(c + 1, r), visit(c - 1, r), visit(c, r + 1), visit(c, r - 1);
    }
    return false;
  }

  /// Between the two radii either verdict is right: cells and beams have a size.
  /// @param goal_tolerance  m, how near to the goal counts as there.
  Verdict verdict(const Band& band, double goal_tolerance) const {
    if (reaches(band.wide, band.near)) return Verdict::kReachable;
    return reaches(band.narrow, goal_tolerance + kCell) ? Verdict::kUndecided
                                                        : Verdict::kUnreachable;
  }

 private:
  std::size_t index(int c, int r) const { return static_cast<std::size_t>(r * columns_ + c); }
  static Eigen::Vector2d center(int c, int r) { return {(c + 0.5) * kCell, (r + 0.5) * kCell}; }

  const Query& query_;
  int columns_, rows_;
  std::vector<double> clearance_;
};

/// Walls with doors that may be too narrow, furniture, and a goal that may lie anywhere.
inline Query randomQuery(unsigned seed) {
  std::mt19937 generator(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(generator()) / 4294967296.0);
  };
  Query query;
  query.world.addFrame(query.width, query.height);
  const int walls = static_cast<int>(uniform(0, 4));
  for (int i = 0; i < walls; ++i) {
    const double at = uniform(2, 10), door = uniform(0.5, 11), gap = uniform(0.3, 1.6);
    if (uniform(0, 1) < 0.5) {
      query.world.add(at, 0, at + 0.1, door);
      query.world.add(at, door + gap, at + 0.1, std::max(door + gap, query.height));
    } else {
      query.world.add(0, at, door, at + 0.1);
      query.world.add(door + gap, at, std::max(door + gap, query.width), at + 0.1);
    }
  }
  const int boxes = static_cast<int>(uniform(0, 25));
  for (int i = 0; i < boxes; ++i) {
    const double x = uniform(0, 12), y = uniform(0, 12);
    query.world.add(x, y, x + uniform(0.1, 2.5), y + uniform(0.1, 2.5));
  }
  do {
    query.start = {uniform(0.4, 11.6), uniform(0.4, 11.6), uniform(-M_PI, M_PI)};
  } while (query.world.clearance(query.start.position()) < 0.35);
  query.goal = {uniform(0.1, 11.9), uniform(0.1, 11.9)};
  return query;
}

}  // namespace cca::testing
