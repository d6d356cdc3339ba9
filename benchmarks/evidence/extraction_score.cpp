// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/extraction_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cross.hpp"

namespace cca::evidence {
namespace {

constexpr double kCorrect = 0.1;                    // m, a ray's error
constexpr double kMatchAngle = 5.0 * M_PI / 180.0;  // rad
constexpr double kMatchDistance = 0.1;              // m
constexpr double kMatchOverlap = 0.5;               // of both lengths
constexpr int kResolvableRays = 5;
constexpr double kBesideEnd = 1e-3;  // rad, a ray may pass beside an end
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double rangeTo(double bearing, const Segment2& segment) {
  const double from = std::atan2(segment.start.y(), segment.start.x());
  const double turn = wrapAngle(std::atan2(segment.end.y(), segment.end.x()) - from);
  const double sign = turn < 0.0 ? -1.0 : 1.0;
  const double here = sign * wrapAngle(bearing - from);
  if (here < -kBesideEnd || here > std::abs(turn) + kBesideEnd) return kInfinity;
  const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing)), d = segment.end - segment.start;
  const double den = cross(d, u), near_end = segment.end.norm() < segment.start.norm() ? 1.0 : 0.0;
  const double t = std::abs(den) < 1e-9 ? near_end : -cross(segment.start, u) / den;
  return (segment.start + std::clamp(t, 0.0, 1.0) * d).norm();
}

/// How a segment lies against an edge.
struct Relation {
  double angle, distance, low, high;  // low, high: the projection's interval on the edge, m
  bool isNear() const { return angle < kMatchAngle && distance < kMatchDistance; }
  double overlap() const { return high - low; }
};

Relation relate(const Segment2& segment, const Segment2& edge) {
  const double length = edge.length();
  const Eigen::Vector2d u = (edge.end - edge.start) / length;
  const Eigen::Vector2d v = (segment.end - segment.start).normalized();
  const Eigen::Vector2d middle = 0.5 * (segment.start + segment.end) - edge.start;
  const double a = u.dot(segment.start - edge.start), b = u.dot(segment.end - edge.start);
  return {std::asin(std::min(1.0, std::abs(cross(v, u)))), std::abs(cross(middle, u)),
          std::clamp(std::min(a, b), 0.0, length), std::clamp(std::max(a, b), 0.0, length)};
}

double unionLength(std::vector<std::pair<double, double>> intervals) {
  std::sort(intervals.begin(), intervals.end());
  double sum = 0.0, reached = -kInfinity;
  for (const auto& [low, high] : intervals) {
    sum += std::max(0.0, high - std::max(low, reached));
    reached = std::max(reached, high);
  }
  return sum;
}

/// Length of `edge` with one of `others` near it.
double coveredLength(const Segment2& edge, const std::vector<Segment2>& others) {
  std::vector<std::pair<double, double>> intervals;
  for (const Segment2& other : others) {
    const Relation r = relate(other, edge);
    if (r.isNear() && r.overlap() > 0.0) intervals.emplace_back(r.low, r.high);
  }
  return unionLength(std::move(intervals));
}

struct Match {
  std::size_t segment, edge;
  Relation relation;
};

std::vector<Match> oneToOne(const std::vector<Segment2>& segments,
                            const std::vector<Segment2>& edges) {
  std::vector<Match> possible, chosen;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t j = 0; j < edges.size(); ++j) {
      const Relation r = relate(segments[i], edges[j]);
      const double least = kMatchOverlap * std::max(segments[i].length(), edges[j].length());
      if (r.isNear() && r.overlap() >= least) possible.push_back({i, j, r});
    }
  }
  std::stable_sort(possible.begin(), possible.end(), [](const Match& a, const Match& b) {
    return a.relation.overlap() > b.relation.overlap();
  });
  std::vector<bool> used_segment(segments.size(), false), used_edge(edges.size(), false);
  for (const Match& m : possible) {
    if (used_segment[m.segment] || used_edge[m.edge]) continue;
    used_segment[m.segment] = used_edge[m.edge] = true;
    chosen.push_back(m);
  }
  return chosen;
}

void scoreAgainstTruth(const LabelledScan& truth, const std::vector<Segment2>& segments,
                       ExtractionScore& score) {
  int resolvable = 0, found = 0, neutral = 0;
  for (const int rays : truth.rays) resolvable += rays >= kResolvableRays;
  double lateral = 0.0, angular = 0.0;
  const std::vector<Match> matches = oneToOne(segments, truth.edges);
  for (const Match& m : matches) {
    (truth.rays[m.edge] >= kResolvableRays ? found : neutral) += 1;
    lateral += m.relation.distance;
    angular += m.relation.angle;
    score.matches.push_back({m.edge, m.relation.distance, m.relation.angle});
  }
  const int claimed = static_cast<int>(segments.size()) - neutral;
  if (claimed > 0) score.precision = static_cast<double>(found) / claimed;
  if (resolvable > 0) {
    score.recall = static_cast<double>(found) / resolvable;
    score.f1 = 2.0 * found / (claimed + resolvable);
  }
  if (!matches.empty()) {
    score.lateral = lateral / static_cast<double>(matches.size());
    score.angular = angular / static_cast<double>(matches.size());
  }
  double length = 0.0, covered = 0.0;
  for (const Segment2& edge : truth.edges) {
    length += edge.length();
    covered += coveredLength(edge, segments);
  }
  if (length > 0.0) score.covered = covered / length;
}

std::vector<Segment2> edgesOf(const std::vector<LineSegment>& segments) {
  std::vector<Segment2> edges;
  for (const LineSegment& s : segments) {
    if (s.length() > 0.0) edges.push_back({s.start, s.end});
  }
  return edges;
}

}  // namespace

std::vector<double> predictedRanges(const Scan& scan, const std::vector<LineSegment>& segments) {
  const std::vector<Segment2> edges = edgesOf(segments);
  std::vector<double> ranges(scan.size(), kInfinity);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    for (const Segment2& e : edges) ranges[i] = std::min(ranges[i], rangeTo(scan.bearing(i), e));
  }
  return ranges;
}

ExtractionScore scoreExtraction(const LabelledScan& truth,
                                const std::vector<LineSegment>& segments) {
  const std::vector<double> predicted = predictedRanges(truth.scan, segments);
  int returns = 0, met = 0, correct = 0, blocked = 0;
  double sum_sq = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    if (!isReturn(truth.scan.ranges[i])) continue;
    ++returns;
    if (!std::isfinite(predicted[i])) continue;
    const double error = predicted[i] - truth.scan.ranges[i];
    ++met;
    sum_sq += error * error;
    correct += std::abs(error) < kCorrect;
    blocked += error < -kCorrect;
  }
  ExtractionScore score;
  score.segments = static_cast<double>(segments.size());
  if (returns > 0) {
    score.explained = static_cast<double>(correct) / returns;
    score.blocked = static_cast<double>(blocked) / returns;
  }
  if (!segments.empty()) score.explained_per_segment = correct / score.segments;
  if (met > 0) score.range_rmse = std::sqrt(sum_sq / met);
  if (truth.has_truth) scoreAgainstTruth(truth, edgesOf(segments), score);
  return score;
}

}  // namespace cca::evidence
