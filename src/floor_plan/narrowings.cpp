// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "floor_plan/components.hpp"
#include "floor_plan/passages.hpp"

namespace cca {
namespace {

constexpr double kJambReach = 0.2;  // m, from the end of a wall

/// Basins of the watershed, each a tree of labels; a label's peak is the clearance that it began
/// at.
class Basins {
 public:
  int create(float peak) {
    parent_.push_back(static_cast<int>(parent_.size()));
    peak_.push_back(peak);
    return parent_.back();
  }
  int root(int label) {
    while (parent_[at(label)] != label)
      label = parent_[at(label)] = parent_[at(parent_[at(label)])];
    return label;
  }
  float peak(int root) const { return peak_[at(root)]; }
  void join(int a, int b) {
    if (peak_[at(a)] < peak_[at(b)]) std::swap(a, b);
    parent_[at(b)] = a;
  }

 private:
  static std::size_t at(int label) { return static_cast<std::size_t>(label); }
  std::vector<int> parent_;
  std::vector<float> peak_;
};

/// Floods the open cells from the widest places down; basins that meet high on the ridge join.
Raster<int> watershed(const Raster<float>& clearance, double ridge_drop) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < clearance.values.size(); ++k) {
    if (clearance.values[k] > 0.0F) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return clearance.values[a] > clearance.values[b];
  });
  Raster<int> labels = clearance.alike(-1);
  Basins basins;
  for (const std::size_t k : order) {
    const Cell c = clearance.cell(k);
    const float here = clearance.values[k];
    int& mine = labels.values[k];
    for (const Cell step : kNeighbours) {
      const int other = labels.at(c + step, -1);
      if (other < 0) continue;
      const int root = basins.root(other);
      if (mine < 0 || basins.root(mine) == root) {
        mine = root;
        continue;
      }
      const int own = basins.root(mine);
      const float lower = std::min(basins.peak(own), basins.peak(root));
      if (here >= ridge_drop * lower) basins.join(own, root);
    }
    if (mine < 0) mine = basins.create(here);
  }
  for (int& label : labels.values) {
    if (label >= 0) label = basins.root(label);
  }
  return labels;
}

/// The two walls that a saddle lies between: the nearest solid cell, and the nearest beyond.
std::optional<Passage> between(const Mask& solid, Cell saddle, double clearance) {
  const int reach = static_cast<int>(2.0 * clearance / solid.resolution) + 3;
  const Eigen::Vector2d middle = middleOf(saddle);
  const auto nearest = [&](const Eigen::Vector2d* opposite) {
    std::optional<Eigen::Vector2d> best;
    double least = std::numeric_limits<double>::infinity();
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (!solid.at(saddle + Cell{x, y}, 1)) continue;
        const Eigen::Vector2d off(x, y);
        const double distance = off.squaredNorm();
        if (distance >= least) continue;
        if (opposite && off.dot(*opposite) > -0.34 * off.norm() * opposite->norm()) continue;
        least = distance;
        best = off;
      }
    }
    return best;
  };
  const auto first = nearest(nullptr);
  if (!first) return std::nullopt;
  const auto second = nearest(&*first);
  if (!second) return std::nullopt;
  // From the face of one cell to that of the other.
  const double shorten = 0.5;
  return Passage{solid.inMetres(middle + *first - shorten * first->normalized()),
                 solid.inMetres(middle + *second - shorten * second->normalized()),
                 PassageEvidence::kNarrowing};
}

bool isWallEnd(const Eigen::Vector2d& jamb, const std::vector<WallEnd>& ends) {
  return std::any_of(ends.begin(), ends.end(), [&](const WallEnd& end) {
    return (end.point - jamb).norm() < 0.5 * end.thickness + kJambReach;
  });
}

}  // namespace

std::vector<Passage> narrowings(const Mask& solid, const Raster<float>& clearance,
                                const std::vector<WallEnd>& ends, const PassageTuning& tuning) {
  const Raster<int> basins = watershed(clearance, tuning.ridge_drop);
  std::map<std::pair<int, int>, std::vector<std::size_t>> borders;
  for (std::size_t k = 0; k < basins.values.size(); ++k) {
    const int own = basins.values[k];
    if (own < 0) continue;
    for (const Cell step : kNeighbours) {
      const int other = basins.at(basins.cell(k) + step, -1);
      if (other > own) borders[{own, other}].push_back(k);
    }
  }
  std::vector<Passage> found;
  Mask border = solid.alike(std::uint8_t{0});
  for (auto& [pair, cells] : borders) {
    // Each piece of a border has a saddle of its own.
    std::sort(cells.begin(), cells.end(), [&](std::size_t a, std::size_t b) {
      if (clearance.values[a] != clearance.values[b])
        return clearance.values[a] > clearance.values[b];
      return a < b;
    });
    std::vector<Eigen::Vector2d> saddles;
    for (const std::size_t k : cells) {
      const Eigen::Vector2d p = middleOf(clearance.cell(k));
      const double width = 2.0 * clearance.values[k] / clearance.resolution;
      const bool is_near = std::any_of(saddles.begin(), saddles.end(), [&](const auto& s) {
        return (s - p).norm() < std::max(width, 8.0) + 8.0;
      });
      if (is_near || 2.0 * clearance.values[k] < tuning.narrowest) continue;
      saddles.push_back(p);
      if (auto passage = between(solid, clearance.cell(k), clearance.values[k])) {
        const int jambs = isWallEnd(passage->a, ends) + isWallEnd(passage->b, ends);
        passage->evidence = jambs == 2   ? PassageEvidence::kCollinear
                            : jambs == 1 ? PassageEvidence::kAbutting
                                         : PassageEvidence::kNarrowing;
        found.push_back(*passage);
      }
    }
  }
  return found;
}

}  // namespace cca
