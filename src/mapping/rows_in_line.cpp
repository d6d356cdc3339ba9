// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/rows_in_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "geometry/cross.hpp"
#include "geometry/square_key.hpp"

namespace cca {
namespace {

constexpr double kLongestGap = 2.0;          // m, between neighbours of a row
constexpr double kBand = 1.0;                // m, to either side of a row, what chance is judged by
constexpr double kLeastOff = 0.03;           // m, of a cluster from its row: half a post
constexpr std::size_t kFewestInRow = 5;      // three fix a row and its spacing, two confirm them
constexpr double kChance = 1e-4;             // maps with a false row
constexpr std::size_t kNeighboursAsked = 6;  // of a cluster, to begin a row with: both sides, three

/// log of the chance that at least `hits` of `tries` come true, each at p.
double logTail(int tries, int hits, double p) {
  double sum = 0.0;
  for (int k = hits; k <= tries; ++k) {
    sum += std::exp(std::lgamma(tries + 1.0) - std::lgamma(k + 1.0) - std::lgamma(tries - k + 1.0) +
                    k * std::log(p) + (tries - k) * std::log1p(-p));
  }
  return std::log(std::max(sum, 1e-300));
}

struct RowCandidate {
  RowInLine row;
  double log_chance = 0.0;
};

class RowSearch {
 public:
  RowSearch(const std::vector<Eigen::Vector2d>& clusters, const MapNoise& noise)
      : clusters_(clusters),
        noise_(noise),
        off_(std::max(kLeastOff, 2.0 * std::sqrt(noise.offsetVariance()))) {
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      at_[squareKey(clusters[i], kLongestGap)].push_back(i);
    }
  }

  /// All rows of enough clusters, each as often as pairs of it begin one.
  std::vector<RowCandidate> candidates() {
    std::vector<RowCandidate> found;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      for (const std::size_t j : neighboursOf(i)) {
        ++seeds_;
        std::vector<std::size_t> members{i, j};
        extend(members);
        std::reverse(members.begin(), members.end());
        extend(members);
        if (members.size() >= kFewestInRow) found.push_back(candidate(std::move(members)));
      }
    }
    return found;
  }

  /// Pairs that a row was begun with so far: as many tests chance has had.
  double seeds() const { return seeds_; }

 private:
  std::vector<std::size_t> around(const Eigen::Vector2d& p) const {
    std::vector<std::size_t> found;
    for (int k = 0; k < 9; ++k) {
      const auto square = at_.find(squareKey(inSquareAround(p, k, kLongestGap), kLongestGap));
      if (square == at_.end()) continue;
      found.insert(found.end(), square->second.begin(), square->second.end());
    }
    return found;
  }

  /// The nearest, that a row may begin with: apart by more than a cluster may be off its row.
  std::vector<std::size_t> neighboursOf(std::size_t i) const {
    const auto distance = [&](std::size_t j) { return (clusters_[j] - clusters_[i]).norm(); };
    std::vector<std::size_t> near = around(clusters_[i]);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](std::size_t j) {
                                const double d = distance(j);
                                return j == i || d < 2.0 * off_ || d > kLongestGap;
                              }),
               near.end());
    std::sort(near.begin(), near.end(),
              [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    if (near.size() > kNeighboursAsked) near.resize(kNeighboursAsked);
    return near;
  }

  /// From the end of a row on, one neighbour after the other, the row fitted anew with each.
  void extend(std::vector<std::size_t>& row) const {
    PointMoments moments = momentsOf(row);
    for (bool grew = true; grew;) {
      const FittedLine line = fitLine(moments);
      const Eigen::Vector2d end = clusters_[row.back()];
      Eigen::Vector2d u = line.direction;
      if (u.dot(end - clusters_[row.front()]) < 0.0) u = -u;
      double nearest = kLongestGap;
      std::size_t next = clusters_.size();
      for (const std::size_t i : around(end)) {
        const double t = u.dot(clusters_[i] - end);
        if (t <= 1e-6 || t >= nearest) continue;
        if (std::abs(cross(u, clusters_[i] - line.centroid)) > off_) continue;
        nearest = t;
        next = i;
      }
      grew = next < clusters_.size();
      if (!grew) continue;
      row.push_back(next);
      moments.add(clusters_[next]);
    }
  }

  PointMoments momentsOf(const std::vector<std::size_t>& row) const {
    PointMoments moments;
    for (const std::size_t i : row) moments.add(clusters_[i]);
    return moments;
  }

  RowCandidate candidate(std::vector<std::size_t> members) const {
    RowCandidate found;
    LineSegment& segment = found.row.segment;
    segment.moments = momentsOf(members);
    const FittedLine line = fitLine(segment.moments);
    const auto project = [&line](const Eigen::Vector2d& p) {
      return Eigen::Vector2d(line.centroid +
                             line.direction * line.direction.dot(p - line.centroid));
    };
    segment.start = project(clusters_[members.front()]);
    segment.end = project(clusters_[members.back()]);
    const double weight = segment.moments.weight;
    const double variance = std::max(noise_.rangeVariance(), line.residual_sum_sq / (weight - 2.0));
    segment.covariance << variance / weight, 0.0, 0.0,
        variance / std::max(variance, line.spread_sum_sq);
    // Two clusters make the line; the others are on it by chance as often as it is wide.
    const int others = static_cast<int>(members.size()) - 2;
    found.log_chance = logTail(std::max(beside(segment) - 2, others), others, off_ / kBand);
    found.row.members = std::move(members);
    return found;
  }

  /// Clusters in the band along a row, its own among them.
  int beside(const LineSegment& segment) const {
    const Eigen::Vector2d u = segment.direction();
    const double length = segment.length();
    return static_cast<int>(
        std::count_if(clusters_.begin(), clusters_.end(), [&](const Eigen::Vector2d& p) {
          const Eigen::Vector2d v = p - segment.start;
          const double t = u.dot(v);
          return t >= 0.0 && t <= length && std::abs(cross(u, v)) < kBand;
        }));
  }

  const std::vector<Eigen::Vector2d>& clusters_;
  const MapNoise& noise_;
  double off_;  ///< m, of a cluster from its row
  double seeds_ = 0.0;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> at_;  ///< clusters by square
};

}  // namespace

std::vector<RowInLine> rowsInLine(const std::vector<Eigen::Vector2d>& clusters,
                                  const MapNoise& noise) {
  RowSearch search(clusters, noise);
  std::vector<RowCandidate> candidates = search.candidates();
  std::sort(candidates.begin(), candidates.end(), [](const RowCandidate& a, const RowCandidate& b) {
    return a.log_chance != b.log_chance ? a.log_chance < b.log_chance
                                        : a.row.members < b.row.members;
  });
  std::vector<bool> is_used(clusters.size(), false);
  std::vector<RowInLine> rows;
  for (RowCandidate& candidate : candidates) {
    if (candidate.log_chance + std::log(search.seeds()) > std::log(kChance)) break;
    const std::vector<std::size_t>& members = candidate.row.members;
    if (std::any_of(members.begin(), members.end(), [&](std::size_t m) { return is_used[m]; }))
      continue;
    for (const std::size_t m : members) is_used[m] = true;
    rows.push_back(std::move(candidate.row));
  }
  return rows;
}

}  // namespace cca
