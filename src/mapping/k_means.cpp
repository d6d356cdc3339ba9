// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/k_means.hpp"

#include <algorithm>
#include <numeric>

namespace cca {
namespace {

using Points = std::vector<Eigen::Vector2d>;

class SortedCentroids {
 public:
  explicit SortedCentroids(const Points& centroids)
      : centroids_(centroids), order_(centroids.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int a, int b) {
      return centroids[a].x() != centroids[b].x() ? centroids[a].x() < centroids[b].x() : a < b;
    });
  }

  int nearest(const Eigen::Vector2d& p) const {
    const auto right = std::lower_bound(order_.begin(), order_.end(), p.x(),
                                        [&](int k, double x) { return centroids_[k].x() < x; });
    int best = -1;
    double best_sq = 0.0;
    const auto outOfReach = [&](int k) {
      const double dx = centroids_[k].x() - p.x();
      if (best >= 0 && dx * dx > best_sq) return true;
      const double sq = (centroids_[k] - p).squaredNorm();
      if (best < 0 || sq < best_sq || (sq == best_sq && k < best)) {
        best = k;
        best_sq = sq;
      }
      return false;
    };
    for (auto it = right; it != order_.end() && !outOfReach(*it); ++it) {
    }
    for (auto it = right; it != order_.begin() && !outOfReach(*(it - 1)); --it) {
    }
    return best;
  }

 private:
  const Points& centroids_;
  std::vector<int> order_;
};

}  // namespace

void moveToMeans(const Points& points, const std::vector<int>& cluster, Points* centroids) {
  Points sum(centroids->size(), Eigen::Vector2d::Zero());
  std::vector<int> count(centroids->size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum[cluster[i]] += points[i];
    ++count[cluster[i]];
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count[k] > 0) (*centroids)[k] = sum[k] / count[k];
  }
}

std::vector<int> kMeans(const Points& points, Points seeds, int sweeps) {
  std::vector<int> cluster(points.size(), 0);
  for (int sweep = 0; sweep < sweeps && !points.empty(); ++sweep) {
    const SortedCentroids sorted(seeds);
    bool moved = sweep == 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int nearest = sorted.nearest(points[i]);
      moved = moved || nearest != cluster[i];
      cluster[i] = nearest;
    }
    if (!moved) break;
    moveToMeans(points, cluster, &seeds);
  }
  return cluster;
}

}  // namespace cca
