// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "mapping/map_similarity.hpp"
#include "mapping/rank_order_clustering.hpp"

namespace cca {
namespace {

using Slot = Walls::Slot;

/// A new line and a wall that resemble each other.
struct Resemblance {
  int line;
  Slot wall;
  double similarity;
};

/// Whether walls explain the line, but for less than SupportProfile::kResolved.
bool isExplained(const NewLine& line, const MapNoise& noise, const Walls& walls) {
  const double length = line.segment.length();
  const int steps = 1 + static_cast<int>(length / SupportProfile::kBinLength);
  int open = 0;
  for (int i = 0; i < steps; ++i) {
    const double share = (i + 0.5) / steps;
    const Eigen::Vector2d p = line.segment.start + share * (line.segment.end - line.segment.start);
    if (walls.hitBy(p, line.viewpoint, kGates * noise.lateralSigma()) >= 0) continue;
    if (length * ++open / steps >= SupportProfile::kResolved) return false;
  }
  return true;
}

void found(NewLine& line, const MapNoise& noise, Walls& walls) {
  if (std::sqrt(line.own_angle_variance) > kDirectionKnown || isExplained(line, noise, walls))
    return;
  line.wall = walls.create();
  Wall& wall = walls[line.wall];
  wall.origin = line.segment.moments.mean;
  wall.direction = line.segment.direction();
}

/// One neighbourhood: its lines, the walls that they resemble, and how much.
class Neighbourhood {
 public:
  Neighbourhood(std::vector<int> members, const std::vector<Resemblance>& resemblances)
      : members_(std::move(members)) {
    for (const Resemblance& r : resemblances) {
      if (std::find(members_.begin(), members_.end(), r.line) == members_.end()) continue;
      if (std::find(walls_.begin(), walls_.end(), r.wall) == walls_.end()) walls_.push_back(r.wall);
    }
  }

  /// Walls first, then lines.
  Eigen::MatrixXd matrix(const std::vector<Resemblance>& resemblances, const MapNoise& noise,
                         const AlphaCut& cut, const Walls& walls) const {
    const int w = static_cast<int>(walls_.size()), n = w + static_cast<int>(members_.size());
    Eigen::MatrixXd s = Eigen::MatrixXd::Identity(n, n);
    const auto set = [&s](int i, int j, double value) { s(i, j) = s(j, i) = value; };
    for (int i = 0; i < w; ++i) {
      for (int j = i + 1; j < w; ++j) {
        set(i, j,
            cut.similarity(mapMemberships(walls[walls_[at(i)]], walls[walls_[at(j)]], noise)));
      }
    }
    for (const Resemblance& r : resemblances) {
      const auto member = std::find(members_.begin(), members_.end(), r.line);
      if (member == members_.end()) continue;
      const auto wall = std::find(walls_.begin(), walls_.end(), r.wall);
      set(static_cast<int>(wall - walls_.begin()), w + static_cast<int>(member - members_.begin()),
          r.similarity);
    }
    for (int i = w; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        // The extraction parted the two; a wall that both are alike speaks for what lies between.
        double alike = 0.0;
        for (int k = 0; k < w; ++k) alike = std::max(alike, std::min(s(i, k), s(j, k)));
        set(i, j, alike);
      }
    }
    return s;
  }

  void assign(const std::vector<int>& group, const Eigen::MatrixXd& s, std::vector<NewLine>& lines,
              const MapNoise& noise, Walls& walls) const {
    const int w = static_cast<int>(walls_.size());
    std::vector<int> of_map, fresh;
    for (const int k : group) (k < w ? of_map : fresh).push_back(k);
    if (of_map.size() > 1) {
      for (const int k : of_map) walls[walls_[at(k)]].hits_at_check = 0.0;
    }
    Slot founded = -1;
    for (const int k : fresh) {
      NewLine& line = lines[at(members_[at(k - w)])];
      double best = 0.0;
      for (const int m : of_map) {
        if (s(k, m) <= best) continue;
        best = s(k, m);
        line.wall = walls_[at(m)];
      }
      if (!of_map.empty()) continue;
      line.wall = founded;
      if (founded < 0) found(line, noise, walls);
      founded = line.wall;
    }
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> members_;
  std::vector<Slot> walls_;
};

/// Rank Order Clustering of a neighbourhood.
std::vector<int> groupsOf(const Eigen::MatrixXd& s, const AlphaCut& cut) {
  SimilarityMatrix sim(static_cast<int>(s.rows()));
  for (int i = 0; i < s.rows(); ++i) {
    for (int j = i + 1; j < s.cols(); ++j) sim.set(i, j, s(i, j));
  }
  return rankOrderGroups(sim, cut);
}

std::vector<Resemblance> resemblances(const std::vector<NewLine>& lines, const AlphaCut& cut,
                                      const MapNoise& noise, const Walls& walls) {
  std::vector<Resemblance> all;
  std::vector<Slot> near;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Eigen::Vector2d reach = lines[i].segment.direction() * kGapOfLine;
    walls.near(lines[i].segment.start - reach, lines[i].segment.end + reach, near);
    for (const Slot slot : near) {
      const double s = cut.similarity(mapMemberships(lines[i], walls[slot], noise));
      if (s >= cut.value) all.push_back({static_cast<int>(i), slot, s});
    }
  }
  return all;
}

}  // namespace

void clusterIntoMap(std::vector<NewLine>& lines, const AlphaCut& cut, const MapNoise& noise,
                    Walls& walls) {
  const std::vector<Resemblance> alike = resemblances(lines, cut, noise, walls);
  // Each line is in the set of the first one that it shares walls with, directly or not.
  std::vector<int> set_of(lines.size());
  std::iota(set_of.begin(), set_of.end(), 0);
  for (std::size_t i = 0; i < alike.size(); ++i) {
    for (std::size_t j = i + 1; j < alike.size(); ++j) {
      if (alike[i].wall != alike[j].wall) continue;
      const auto [first, other] = std::minmax({set_of[alike[i].line], set_of[alike[j].line]});
      std::replace(set_of.begin(), set_of.end(), other, first);
    }
  }
  std::vector<std::vector<int>> members(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) members[set_of[i]].push_back(static_cast<int>(i));
  for (std::vector<int>& m : members) {
    if (m.empty()) continue;
    const Neighbourhood neighbourhood(std::move(m), alike);
    const Eigen::MatrixXd s = neighbourhood.matrix(alike, noise, cut, walls);
    const std::vector<int> group_of = groupsOf(s, cut);
    std::vector<std::vector<int>> groups(group_of.size());
    for (std::size_t i = 0; i < group_of.size(); ++i) {
      groups[static_cast<std::size_t>(group_of[i])].push_back(static_cast<int>(i));
    }
    for (const std::vector<int>& group : groups) {
      if (!group.empty()) neighbourhood.assign(group, s, lines, noise, walls);
    }
  }
}

}  // namespace cca
