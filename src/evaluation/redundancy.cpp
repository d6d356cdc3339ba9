// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"

#include "log_score_parts.hpp"

namespace cca::log_score {
namespace {

constexpr double kParallel = 10.0 * M_PI / 180.0, kJoinable = 3.0 * M_PI / 180.0;  // rad
constexpr double kNear = 0.05, kBeside = 0.10, kGap = 0.30, kFacing = 0.06;        // m
constexpr std::size_t kMostFacingPoints = 100000;
constexpr double kFewestVotes = 3.0;

double direction(const Segment2& s) {
  return std::atan2(s.end.y() - s.start.y(), s.end.x() - s.start.x());
}

double angleBetweenLines(double a, double b) { return std::abs(std::remainder(a - b, M_PI)); }

/// Which side each segment was seen from: +1 left, -1 right, 0 both or unknown.
std::vector<double> facing(const std::vector<Segment2>& map, const SegmentIndex& index,
                           const std::vector<Eigen::Vector2d>& points,
                           const std::vector<Eigen::Vector2d>& origins) {
  std::vector<double> votes(map.size(), 0.0), number(map.size(), 0.0);
  const std::size_t stride =
      std::max<std::size_t>(1, (points.size() + kMostFacingPoints - 1) / kMostFacingPoints);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    for (const std::size_t s : index.within(points[i], kFacing)) {
      const Eigen::Vector2d u = (map[s].end - map[s].start).normalized();
      const Eigen::Vector2d v = origins[i] - map[s].start;
      const double side = cross(u, v);
      if (std::abs(side) <= 0.10) continue;
      votes[s] += side > 0.0 ? 1.0 : -1.0;
      number[s] += 1.0;
    }
  }
  for (std::size_t s = 0; s < map.size(); ++s) {
    votes[s] = number[s] >= kFewestVotes ? votes[s] / number[s] : 0.0;
  }
  return votes;
}

double lateral(const Eigen::Vector2d& p, const Segment2& s, double theta) {
  const Eigen::Vector2d d = p - s.start;
  return std::abs(std::cos(theta) * d.y() - std::sin(theta) * d.x());
}

std::size_t joinablePairs(const std::vector<Segment2>& map, const SegmentIndex& index,
                          const std::vector<double>& theta) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    for (const std::size_t j : index.within(map[i], kGap)) {
      if (j <= i || angleBetweenLines(theta[i], theta[j]) > kJoinable) continue;
      const double offset = std::max(
          {lateral(map[i].start, map[j], theta[j]), lateral(map[i].end, map[j], theta[j]),
           lateral(map[j].start, map[i], theta[i]), lateral(map[j].end, map[i], theta[i])});
      if (offset <= kNear) ++pairs;
    }
  }
  return pairs;
}

}  // namespace

Redundancy redundancy(const std::vector<Segment2>& map, const SegmentIndex& index,
                      const MapSamples& samples, const std::vector<std::size_t>& picked,
                      const std::vector<Eigen::Vector2d>& points,
                      const std::vector<Eigen::Vector2d>& origins) {
  Redundancy out;
  out.neighbours.assign(samples.size(), 0);
  if (map.empty()) return out;
  const std::vector<double> face = facing(map, index, points, origins);
  std::vector<double> theta;
  double total = 0.0;
  for (const auto& s : map) theta.push_back(direction(s)), total += s.length();

  double sum = 0.0, once = 0.0, near = 0.0, beside = 0.0, multiplicity = 0.0;
  for (const std::size_t k : picked) {
    const std::size_t own = samples.segment[k];
    std::size_t n_near = 0, n_beside = 0;
    for (const std::size_t other : index.within(samples.xy[k], kBeside)) {
      if (other == own || angleBetweenLines(theta[other], theta[own]) > kParallel) continue;
      const double turn = std::cos(theta[other] - theta[own]);
      if (face[other] * face[own] * (turn > 0.0 ? 1.0 : turn < 0.0 ? -1.0 : 0.0) < -0.25) continue;
      ++n_beside;
      if (distance(samples.xy[k], map[other]) <= kNear) ++n_near;
    }
    const double w = samples.length[k];
    sum += w;
    once += w / (1.0 + static_cast<double>(n_beside));
    multiplicity += w * (1.0 + static_cast<double>(n_beside));
    near += n_near > 0 ? w : 0.0;
    beside += n_beside > 0 ? w : 0.0;
    out.neighbours[k] = n_beside;
  }
  out.fraction_05 = near / sum;
  out.fraction_10 = beside / sum;
  out.multiplicity = multiplicity / sum;
  out.dedup_length = total * once / sum;
  out.joinable_pairs = joinablePairs(map, index, theta);
  return out;
}

}  // namespace cca::log_score
