// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/loose_returns.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/distance_to_segment.hpp"
#include "geometry/square_key.hpp"
#include "mapping/description_length.hpp"
#include "mapping/rows_in_line.hpp"

namespace cca {
namespace {

constexpr double kPlaceSize = 0.1;       // m: two posts' width; neighbours of a row stay apart
constexpr double kFloorCell = 1.0;       // m, in which scans are counted
constexpr double kNewLook = 0.5;         // m, from the last scan kept in a cell
constexpr double kFarthestLook = 12.0;   // m, at which beams still tell posts apart
constexpr std::size_t kFewestLooks = 3;  // from different places: no passer-by; one more is kept
constexpr double kBesideWall = 0.15;     // m; what stands nearer is the wall's own fringe
constexpr double kLeastShare = 0.1;      // of the rays, that a cluster returns; a pane does a fifth
constexpr int kRefuting = 20;            // rays in a row: one pane's cluster in a hundred

}  // namespace

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
  auto& here = looks_at_[squareKey(last_.position(), kFloorCell)];
  if (here.size() <= kFewestLooks) {  // bounds the memory
    here.push_back(looks_.size());
    looks_.push_back(std::move(look));
  } else {  // the oldest of them goes
    std::rotate(here.begin(), here.begin() + 1, here.end());
    looks_[here.back()] = std::move(look);
  }
  for (const Eigen::Vector2d& p : loose) {
    Place& place = places_[squareKey(p, kPlaceSize)];
    place.sum += p;
    place.returns += 1.0;
    place.ranges += (p - last_.position()).norm();
    place.looks += place.last != number_;
    place.last = number_;
  }
}

/// K-means whose means begin at the places seen most often, each taking over what lies around it.
std::vector<LooseReturns::Cluster> LooseReturns::clusters(const std::vector<MapLine>& walls,
                                                          const MapNoise& noise) const {
  struct Seed {
    Cluster cluster;
    double returns;
    double beside;  ///< m, up to which a wall may have scattered them
    std::int64_t key;
  };
  // One return in 45 000 is scattered farther, and a wall has some thousands.
  const double fringe = std::sqrt(2.0 * kPointPrice);
  std::vector<Seed> seeds;
  for (const auto& [key, place] : places_) {
    if (place.looks < static_cast<int>(kFewestLooks)) continue;
    const double scatter = std::sqrt(noise.lateralVariance(place.ranges / place.returns));
    seeds.push_back({{place.sum / place.returns, place.looks},
                     place.returns,
                     std::max(kBesideWall, fringe * scatter),
                     key});
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
    return a.returns != b.returns ? a.returns > b.returns : a.key < b.key;
  });
  std::vector<Cluster> means;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> at;
  for (const Seed& seed : seeds) {
    const Eigen::Vector2d& p = seed.cluster.mean;
    bool is_taken = std::any_of(walls.begin(), walls.end(), [&](const MapLine& wall) {
      return distanceToSegment(wall.segment.start, wall.segment.end, p) < seed.beside;
    });
    for (int k = 0; k < 9 && !is_taken; ++k) {
      const Eigen::Vector2d beside = inSquareAround(p, k, kPlaceSize);
      for (const std::size_t other : at[squareKey(beside, kPlaceSize)]) {
        is_taken = is_taken || (means[other].mean - p).norm() < kPlaceSize;
      }
    }
    if (is_taken) continue;
    at[squareKey(p, kPlaceSize)].push_back(means.size());
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
    if (range > kFarthestLook || range * std::abs(look.angle_increment) > kPlaceSize) continue;
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
  const int steps = std::max(1, static_cast<int>(row.length() / SupportProfile::kBinLength));
  for (int k = 0; k <= steps; ++k) {
    const Verdict v = ask(row.start + (row.end - row.start) * k / steps);
    all.returned += v.returned;
    all.passed += v.passed;
  }
  return all.returned / std::max(1.0, static_cast<double>(all.returned + all.passed));
}

std::vector<MapLine> LooseReturns::dottedWalls(const std::vector<MapLine>& walls,
                                               const MapNoise& noise) const {
  const std::vector<Cluster> all = clusters(walls, noise);
  std::vector<Eigen::Vector2d> means;
  for (const Cluster& cluster : all) means.push_back(cluster.mean);
  std::vector<MapLine> found;
  for (const RowInLine& row : rowsInLine(means, noise)) {
    MapLine line;
    line.segment = row.segment;
    line.kind = LineKind::kDotted;
    for (const std::size_t m : row.members) line.support += all[m].looks;
    line.share = shareOf(row.segment);
    found.push_back(line);
  }
  return found;
}

}  // namespace cca
