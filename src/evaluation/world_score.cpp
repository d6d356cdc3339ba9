// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/world_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "log_score_parts.hpp"

namespace cca {
namespace {

using namespace log_score;

double angleBetween(const Segment2& a, const Segment2& b) {
  const Eigen::Vector2d u = a.end - a.start, v = b.end - b.start;
  return std::abs(std::remainder(std::atan2(v.y(), v.x()) - std::atan2(u.y(), u.x()), M_PI));
}

/// The nearest segment of `others` that lies within both tolerances of a point on `segment`, or
/// npos; also how many do.
struct Match {
  std::size_t index = SegmentIndex::npos;
  double distance = 0.0;
  std::size_t number = 0;
};

Match match(const Eigen::Vector2d& point, const Segment2& segment, std::size_t self,
            const std::vector<Segment2>& others, const SegmentIndex& index,
            const WorldScoreParameters& p) {
  Match best;
  for (const std::size_t k : index.within(point, p.tolerance)) {
    if (k == self || angleBetween(segment, others[k]) > p.angle_tolerance_deg * M_PI / 180.0) {
      continue;
    }
    ++best.number;
    const double d = distance(point, others[k]);
    if (best.index == SegmentIndex::npos || d < best.distance) best.index = k, best.distance = d;
  }
  return best;
}

std::vector<Eigen::Vector2d> endsOf(const std::vector<Segment2>& segments) {
  std::vector<Eigen::Vector2d> ends;
  for (const auto& s : segments) ends.insert(ends.end(), {s.start, s.end});
  return ends;
}

std::vector<double> distancesToNearest(const std::vector<Eigen::Vector2d>& points,
                                       const std::vector<Eigen::Vector2d>& others) {
  const PointIndex index(others);
  std::vector<double> distances;
  if (others.empty()) return distances;
  for (const auto& p : points) {
    distances.push_back(index.nearestDistance(p, std::numeric_limits<double>::max()));
  }
  return distances;
}

/// Share of `ends` whose distance is within the tolerance; NaN where there are none.
double shareFound(const std::vector<Eigen::Vector2d>& ends, const std::vector<double>& distances,
                  double tolerance) {
  return ends.empty() ? kNaN : shareWithin(distances, tolerance);
}

}  // namespace

LogScore scoreAgainstWorld(const std::vector<Segment2>& all_truth,
                           const std::vector<Segment2>& all_map, const WorldScoreParameters& p) {
  const std::vector<Segment2> truth = withLength(all_truth), map = withLength(all_map);
  if (truth.empty()) throw std::runtime_error("the world has no true segment to judge a map by");
  const SegmentIndex truth_index(truth), map_index(map);
  const auto map_samples = sampleMap(map, p.step);
  const auto truth_samples = sampleMap(truth, p.step);

  double map_length = 0.0, right = 0.0, once = 0.0, squares = 0.0, angles = 0.0, redundant = 0.0;
  std::vector<double> laterals;
  for (std::size_t k = 0; k < map_samples.size(); ++k) {
    const Segment2& own = map[map_samples.segment[k]];
    const double w = map_samples.length[k];
    const Match twin = match(map_samples.xy[k], own, map_samples.segment[k], map, map_index, p);
    const Match hit = match(map_samples.xy[k], own, SegmentIndex::npos, truth, truth_index, p);
    // As many parallel lines may lie here as there are true ones: both faces of a thin wall.
    const double share = static_cast<double>(hit.number) / (1.0 + static_cast<double>(twin.number));
    map_length += w;
    redundant += twin.number > 0 && share < 1.0 ? w : 0.0;
    if (hit.index == SegmentIndex::npos) continue;
    right += w;
    once += w * std::min(1.0, share);
    squares += w * hit.distance * hit.distance;
    angles += w * angleBetween(own, truth[hit.index]);
    laterals.push_back(hit.distance);
  }
  double truth_length = 0.0, found = 0.0;
  for (std::size_t k = 0; k < truth_samples.size(); ++k) {
    const Match hit = match(truth_samples.xy[k], truth[truth_samples.segment[k]],
                            SegmentIndex::npos, map, map_index, p);
    truth_length += truth_samples.length[k];
    found += hit.index == SegmentIndex::npos ? 0.0 : truth_samples.length[k];
  }
  const auto map_ends = endsOf(map), truth_ends = endsOf(truth);
  const auto map_to_truth = distancesToNearest(map_ends, truth_ends);
  const auto truth_to_map = distancesToNearest(truth_ends, map_ends);

  const double precision = map_length > 0.0 ? once / map_length : kNaN;
  const double recall = found / truth_length;
  const double sum = map_length > 0.0 ? precision + recall : 0.0;
  return {{{"world",
            {{"truth_length_m", truth_length},
             {"map_length_m", map_length},
             {"segments", static_cast<double>(map.size())},
             {"precision", precision},
             {"recall", recall},
             {"f1", sum > 0.0 ? 2.0 * precision * recall / sum : 0.0},
             {"redundant", map_length > 0.0 ? redundant / map_length : 0.0},
             {"lateral_rms_m", right > 0.0 ? std::sqrt(squares / right) : kNaN},
             {"lateral_median_m", ranked(laterals, 0.5)},
             {"angle_mean_deg", right > 0.0 ? angles / right * 180.0 / M_PI : kNaN},
             {"end_error_median_m", ranked(map_to_truth, 0.5)},
             {"end_error_p90_m", ranked(map_to_truth, 0.9)},
             {"vertices_found", shareFound(truth_ends, truth_to_map, p.tolerance)},
             {"vertices_right", shareFound(map_ends, map_to_truth, p.tolerance)}}}}};
}

}  // namespace cca
