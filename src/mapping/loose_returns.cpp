// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/loose_returns.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kPlaceSize = 0.1;       // m: two posts' width; neighbours of a row stay apart
constexpr double kFloorCell = 1.0;       // m, in which scans are counted
constexpr std::size_t kMostLooks = 4;    // one more than the fewest: bounds the memory
constexpr double kNewLook = 0.5;         // m, from the last scan kept in a cell
constexpr double kFarthestLook = 12.0;   // m, at which beams still tell posts apart
constexpr double kWidestBeam = 0.1;      // m, between beams where they are asked
constexpr int kFewestLooks = 3;          // from different places: no passer-by
constexpr double kBesideWall = 0.15;     // m; what stands nearer is the wall's own fringe
constexpr double kLeastShare = 0.1;      // of the rays, that a cluster returns; a pane does a fifth
constexpr int kRefuting = 20;            // rays in a row: one pane's cluster in a hundred
constexpr double kLongestGap = 2.0;      // m, between neighbours of a row
constexpr double kBand = 1.0;            // m, to either side of a row, what chance is judged by
constexpr double kLeastOff = 0.03;       // m, of a cluster from its row: half a post
constexpr std::size_t kFewestInRow = 5;  // three fix a row and its spacing, two confirm them
constexpr double kChance = 1e-4;         // maps with a false row
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

double distanceTo(const LineSegment& s, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = s.end - s.start;
  const double t = std::clamp(along.dot(p - s.start) / along.squaredNorm(), 0.0, 1.0);
  return (p - s.start - t * along).norm();
}

}  // namespace

std::int64_t LooseReturns::keyOf(const Eigen::Vector2d& p, double cell) {
  const auto x = static_cast<std::int64_t>(std::floor(p.x() / cell));
  const auto y = static_cast<std::int64_t>(std::floor(p.y() / cell));
  return x * (std::int64_t{1} << 32) + y;
}

bool LooseReturns::wants(const Scan& scan) const {
  const Pose2& T = scan.T_map_sensor;
  return number_ == 0 || (last_.position() - T.position()).norm() >= kNewLook ||
         std::abs(wrapAngle(T.theta - last_.theta)) > kNewLook;
}

void LooseReturns::add(const Scan& scan, const std::vector<Eigen::Vector2d>& loose) {
  last_ = scan.T_map_sensor;
  Look look{++number_, scan.T_map_sensor, scan.angle_min, scan.angle_increment, {}, {}};
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = scan.ranges[beam];
    look.ranges.push_back(static_cast<float>(isReturn(range) ? range : 0.0));
    look.free.push_back(static_cast<float>(scan.freeRange(beam)));
  }
  auto& here = looks_at_[keyOf(last_.position(), kFloorCell)];
  if (here.size() < kMostLooks) {
    here.push_back(looks_.size());
    looks_.push_back(std::move(look));
  } else {  // the oldest of them goes
    std::rotate(here.begin(), here.begin() + 1, here.end());
    looks_[here.back()] = std::move(look);
  }
  for (const Eigen::Vector2d& p : loose) {
    Place& place = places_[keyOf(p, kPlaceSize)];
    place.sum += p;
    place.returns += 1.0;
    place.looks += place.last != number_;
    place.last = number_;
  }
}

/// K-means whose means begin at the places seen most often, each taking over what lies around it.
std::vector<LooseReturns::Cluster> LooseReturns::clusters(const std::vector<MapLine>& walls) const {
  struct Seed {
    Cluster cluster;
    double returns;
    std::int64_t key;
  };
  std::vector<Seed> seeds;
  for (const auto& [key, place] : places_) {
    if (place.looks < kFewestLooks) continue;
    seeds.push_back({{place.sum / place.returns, place.looks}, place.returns, key});
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
    return a.returns != b.returns ? a.returns > b.returns : a.key < b.key;
  });
  std::vector<Cluster> means;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> at;
  for (const Seed& seed : seeds) {
    const Eigen::Vector2d& p = seed.cluster.mean;
    bool is_taken = std::any_of(walls.begin(), walls.end(), [&p](const MapLine& wall) {
      return distanceTo(wall.segment, p) < kBesideWall;
    });
    for (int k = 0; k < 9 && !is_taken; ++k) {
      const Eigen::Vector2d beside = p + kPlaceSize * Eigen::Vector2d(k % 3 - 1, k / 3 - 1);
      for (const std::size_t other : at[keyOf(beside, kPlaceSize)]) {
        is_taken = is_taken || (means[other].mean - p).norm() < kPlaceSize;
      }
    }
    if (is_taken) continue;
    at[keyOf(p, kPlaceSize)].push_back(means.size());
    means.push_back(seed.cluster);
  }
  means.erase(std::remove_if(means.begin(), means.end(),
                             [this](const Cluster& c) {
                               const Verdict v = ask(c.mean);
                               return v.passed_since >= kRefuting ||
                                      v.returned < kLeastShare * (v.returned + v.passed);
                             }),
              means.end());
  return means;
}

/// What the scans that have looked there say: each by the beam that points there.
LooseReturns::Verdict LooseReturns::ask(const Eigen::Vector2d& p) const {
  Verdict verdict;
  std::size_t last_return = 0;
  std::vector<std::size_t> passed;
  for (const Look& look : looks_) {
    const Eigen::Vector2d v = look.T_map_sensor.inverse() * p;
    const double range = v.norm();
    if (range > kFarthestLook || range * std::abs(look.angle_increment) > kWidestBeam) continue;
    const double turned =
        std::remainder(std::atan2(v.y(), v.x()) - look.angle_min -
                           0.5 * look.angle_increment * static_cast<double>(look.ranges.size()),
                       2.0 * M_PI);
    const double beam =
        turned / look.angle_increment + 0.5 * static_cast<double>(look.ranges.size());
    if (beam < 0.0 || beam > static_cast<double>(look.ranges.size()) - 0.51) continue;
    const auto k = static_cast<std::size_t>(std::lround(beam));
    if (std::abs(look.ranges[k] - range) < kPlaceSize) {
      ++verdict.returned;
      last_return = std::max(last_return, look.number);
    }
    if (look.free[k] > range + kPlaceSize) passed.push_back(look.number);
  }
  verdict.passed = static_cast<int>(passed.size());
  verdict.passed_since = static_cast<int>(std::count_if(
      passed.begin(), passed.end(), [&](std::size_t number) { return number > last_return; }));
  return verdict;
}

double LooseReturns::shareOf(const LineSegment& row) const {
  Verdict all;
  constexpr double kStep = 0.05;  // m, a bin of a wall
  const int steps = std::max(1, static_cast<int>(row.length() / kStep));
  for (int k = 0; k <= steps; ++k) {
    const Verdict v = ask(row.start + (row.end - row.start) * k / steps);
    all.returned += v.returned;
    all.passed += v.passed;
  }
  return all.returned / std::max(1.0, static_cast<double>(all.returned + all.passed));
}

/// Clusters on one line, in order along it.
struct LooseReturns::Row {
  std::vector<std::size_t> members;
  LineSegment segment;
  double log_chance = 0.0;
};

std::vector<MapLine> LooseReturns::dottedWalls(const std::vector<MapLine>& walls,
                                               const MapNoise& noise) const {
  const std::vector<Cluster> means = clusters(walls);
  const double off = std::max(kLeastOff, 2.0 * std::sqrt(noise.offsetVariance()));
  std::unordered_map<std::int64_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < means.size(); ++i) {
    at[keyOf(means[i].mean, kLongestGap)].push_back(i);
  }
  const auto around = [&](const Eigen::Vector2d& p) {
    std::vector<std::size_t> found;
    for (int k = 0; k < 9; ++k) {
      const auto cell =
          at.find(keyOf(p + kLongestGap * Eigen::Vector2d(k % 3 - 1, k / 3 - 1), kLongestGap));
      if (cell != at.end()) found.insert(found.end(), cell->second.begin(), cell->second.end());
    }
    return found;
  };
  // From the end of a row on, one neighbour after the other, the row fitted anew with each.
  const auto grow = [&](std::vector<std::size_t>* row) {
    PointMoments moments;
    for (const std::size_t i : *row) moments.add(means[i].mean);
    for (bool grew = true; grew;) {
      const FittedLine line = fitLine(moments);
      const Eigen::Vector2d end = means[row->back()].mean;
      Eigen::Vector2d u = line.direction;
      if (u.dot(end - means[row->front()].mean) < 0.0) u = -u;
      double nearest = kLongestGap;
      std::size_t next = means.size();
      for (const std::size_t i : around(end)) {
        const double t = u.dot(means[i].mean - end);
        if (t <= 1e-6 || t >= nearest) continue;
        if (std::abs(cross(u, means[i].mean - line.centroid)) > off) continue;
        nearest = t;
        next = i;
      }
      grew = next < means.size();
      if (!grew) continue;
      row->push_back(next);
      moments.add(means[next].mean);
    }
  };
  std::vector<Row> rows;
  double tests = 0.0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    std::vector<std::size_t> near = around(means[i].mean);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](std::size_t j) {
                                const double d = (means[j].mean - means[i].mean).norm();
                                return j == i || d < 2.0 * off || d > kLongestGap;
                              }),
               near.end());
    std::sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
      return (means[a].mean - means[i].mean).norm() < (means[b].mean - means[i].mean).norm();
    });
    if (near.size() > kNeighboursAsked) near.resize(kNeighboursAsked);
    for (const std::size_t j : near) {
      tests += 1.0;
      Row row;
      row.members = {i, j};
      grow(&row.members);
      std::reverse(row.members.begin(), row.members.end());
      grow(&row.members);
      if (row.members.size() < kFewestInRow) continue;
      PointMoments moments;
      for (const std::size_t m : row.members) moments.add(means[m].mean);
      const FittedLine line = fitLine(moments);
      const auto project = [&](const Eigen::Vector2d& p) {
        return Eigen::Vector2d(line.centroid +
                               line.direction * line.direction.dot(p - line.centroid));
      };
      row.segment.start = project(means[row.members.front()].mean);
      row.segment.end = project(means[row.members.back()].mean);
      row.segment.moments = moments;
      const double variance =
          std::max(noise.rangeVariance(), line.residual_sum_sq / (moments.weight - 2.0));
      row.segment.covariance << variance / moments.weight, 0.0, 0.0,
          variance / std::max(variance, line.spread_sum_sq);
      int beside = 0;
      for (const Cluster& c : means) {
        const Eigen::Vector2d v = c.mean - row.segment.start, u = row.segment.direction();
        const double t = u.dot(v);
        beside += t >= 0.0 && t <= row.segment.length() && std::abs(cross(u, v)) < kBand;
      }
      // Two clusters make the line; the others are on it by chance as often as it is wide.
      const int others = static_cast<int>(row.members.size()) - 2;
      row.log_chance = logTail(std::max(beside - 2, others), others, off / kBand);
      rows.push_back(std::move(row));
    }
  }
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.log_chance != b.log_chance ? a.log_chance < b.log_chance : a.members < b.members;
  });
  std::vector<bool> is_used(means.size(), false);
  std::vector<MapLine> found;
  for (const Row& row : rows) {
    if (row.log_chance + std::log(tests) > std::log(kChance)) break;
    if (std::any_of(row.members.begin(), row.members.end(),
                    [&](std::size_t m) { return is_used[m]; })) {
      continue;
    }
    for (const std::size_t m : row.members) is_used[m] = true;
    MapLine line;
    line.segment = row.segment;
    line.kind = LineKind::kDotted;
    for (const std::size_t m : row.members) line.support += means[m].looks;
    line.share = shareOf(row.segment);
    found.push_back(line);
  }
  return found;
}

}  // namespace cca
