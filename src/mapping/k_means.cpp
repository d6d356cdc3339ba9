// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/k_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "cca_mrpt/mapping/cross.hpp"

namespace cca {
namespace {

/// Centroids in cyclic order of bearing.
class CentroidRing {
 public:
  explicit CentroidRing(const std::vector<Eigen::Vector2d>& centroids)
      : ring_(centroids.size()), place_(centroids.size()) {
    const std::vector<int> order = byBearing(centroids);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Eigen::Vector2d& c = centroids[order[k]];
      const double norm = c.norm();
      ring_[k] = {c, norm > 0.0 ? Eigen::Vector2d(c / norm) : Eigen::Vector2d::Zero(), order[k],
                  0.0};
      place_[order[k]] = static_cast<int>(k);
    }
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      ring_[k].unrivalled_sq = kQuarter * leastSqToOthers(static_cast<int>(k));
    }
  }

  /// Index of the centroid nearest to p, the lowest where several are; starts beside `guess`.
  int nearest(const Eigen::Vector2d& p, int guess) const {
    const int n = static_cast<int>(ring_.size()), start = place_[guess];
    int best = guess;
    double best_sq = (p - ring_[start].centroid).squaredNorm();
    if (best_sq < ring_[start].unrivalled_sq) return guess;
    for (const int step : {1, n - 1}) {
      int place = start;
      for (int walked = 1; walked < n; ++walked) {
        place += step;
        if (place >= n) place -= n;
        const Member& m = ring_[place];
        if (lowerBoundSq(p, m.ray) > best_sq) break;
        const double sq = (p - m.centroid).squaredNorm();
        if (sq < best_sq || (sq == best_sq && m.index < best)) {
          best_sq = sq;
          best = m.index;
        }
      }
    }
    return best;
  }

 private:
  struct Member {
    Eigen::Vector2d centroid, ray;
    int index;
    /// m^2; points nearer than half the way to the next centroid have no other nearest.
    double unrivalled_sq = 0.0;
  };
  static constexpr double kQuarter = 0.25 * (1.0 - 1e-9);  // the square of half, less rounding

  /// No other centroid is nearer: those beside it in the ring are asked, and the rays of the next
  /// ones, for what follows lies farther off.
  double leastSqToOthers(int own) const {
    const Eigen::Vector2d& c = ring_[own].centroid;
    const int n = static_cast<int>(ring_.size());
    double least_sq = std::numeric_limits<double>::infinity();
    for (const int step : {1, n - 1}) {
      const Member &beside = ring_[(own + step) % n], &beyond = ring_[(own + 2 * step) % n];
      least_sq =
          std::min({least_sq, (c - beside.centroid).squaredNorm(), lowerBoundSq(c, beyond.ray)});
    }
    return least_sq;
  }

  /// Centroids of a scan mostly follow one another already: bearings are asked for only if not.
  static std::vector<int> byBearing(const std::vector<Eigen::Vector2d>& centroids) {
    const std::size_t n = centroids.size();
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    bool in_order = true;
    for (std::size_t k = 1; k < n && in_order; ++k) {
      in_order = cross(centroids[k - 1], centroids[k]) > 0.0;
    }
    if (in_order) return order;
    std::vector<double> bearing(n);
    for (std::size_t k = 0; k < n; ++k) bearing[k] = std::atan2(centroids[k].y(), centroids[k].x());
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return bearing[a] < bearing[b]; });
    return order;
  }

  /// Squared distance of p from the ray on which a centroid lies.
  static double lowerBoundSq(const Eigen::Vector2d& p, const Eigen::Vector2d& ray) {
    if (p.dot(ray) <= 0.0) return ray.isZero() ? 0.0 : p.squaredNorm();
    const double off = cross(p, ray);
    return off * off * (1.0 - 1e-12);
  }

  std::vector<Member> ring_;
  std::vector<int> place_;
};

/// Lloyd's other half: moves each centroid to the mean of its points; one without points stays.
void moveToMeans(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& cluster,
                 std::vector<Eigen::Vector2d>* centroids) {
  std::vector<Eigen::Vector2d> sum(centroids->size(), Eigen::Vector2d::Zero());
  std::vector<int> count(centroids->size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum[cluster[i]] += points[i];
    ++count[cluster[i]];
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count[k] > 0) (*centroids)[k] = sum[k] / count[k];
  }
}

}  // namespace

std::vector<int> kMeansInOrder(const ScanPoints& points, int clusters, int sweeps) {
  const int n = static_cast<int>(points.size());
  std::vector<int> cluster(n, 0);
  if (n == 0) return cluster;
  std::vector<Eigen::Vector2d> centroids(clusters);
  for (int k = 0; k < clusters; ++k) {
    const double middle = (k + 0.5) * n / clusters;
    centroids[k] = points.positions[std::min(n - 1, static_cast<int>(middle))];
  }
  for (int i = 0; i < n; ++i) {
    cluster[i] = std::min(clusters - 1, static_cast<int>((i + 0.5) * clusters / n));
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const CentroidRing ring(centroids);
    bool moved = sweep == 0;
    for (int i = 0; i < n; ++i) {
      const int nearest = ring.nearest(points.positions[i], cluster[i]);
      moved = moved || nearest != cluster[i];
      cluster[i] = nearest;
    }
    if (!moved || sweep + 1 == sweeps) break;
    moveToMeans(points.positions, cluster, &centroids);
  }
  return cluster;
}

}  // namespace cca
