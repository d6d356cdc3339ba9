// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "log_score_parts.hpp"

namespace cca::log_score {
namespace {

constexpr double kUnsupportedRun = 0.5;  // m
constexpr double kFarthest = 1.0;        // m, distances are capped here

double mean(const std::vector<double>& values) {
  if (values.empty()) return kNaN;
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / count(values.size());
}

/// k(d) = exp(-d^2 / (2 smear^2)), cut at two deviations.
double kernel(double d, double smear) {
  return d <= 2.0 * smear ? std::exp(-0.5 * (d / smear) * (d / smear)) : 0.0;
}

/// Length in runs of unsupported samples of one segment that are longer than kUnsupportedRun.
double unsupportedRuns(const MapSamples& samples, const std::vector<bool>& unsupported) {
  double total = 0.0;
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin;
    double length = 0.0;
    while (end < samples.size() && samples.segment[end] == samples.segment[begin] &&
           unsupported[end] == unsupported[begin]) {
      length += samples.length[end++];
    }
    if (unsupported[begin] && length > kUnsupportedRun) total += length;
    begin = end;
  }
  return total;
}

}  // namespace

ScoreGroup scorePoints(const EndPoints& ends, const SegmentIndex& index,
                       const LogScoreParameters& p) {
  std::vector<std::size_t> tested;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends.range[i] <= p.range_max) tested.push_back(i);
  }
  const auto stride = static_cast<std::size_t>(
      std::max(1.0, std::ceil(count(tested.size()) / static_cast<double>(p.max_points))));
  std::vector<double> all, near, inliers;
  double kernels = 0.0;
  for (const std::size_t i : tested) {
    if (ends.scan[i] % stride != 0) continue;
    const double d = index.nearest(ends.xy[i], kFarthest).distance;
    all.push_back(d);
    if (ends.range[i] <= p.range_near) near.push_back(d);
    if (d <= 0.20) inliers.push_back(d);
    kernels += kernel(d, p.smear);
  }
  double squares = 0.0;
  for (const double d : inliers) squares += d * d;
  return {"points",
          {{"tested", count(all.size())},
           {"range_max_m", p.range_max},
           {"range_near_m", p.range_near},
           {"explained_05", shareWithin(all, 0.05)},
           {"explained_10", shareWithin(all, 0.10)},
           {"explained_20", shareWithin(all, 0.20)},
           {"explained_05_near", shareWithin(near, 0.05)},
           {"explained_10_near", shareWithin(near, 0.10)},
           {"mean_dist_capped1m", mean(all)},
           {"median_dist_m", quantile(all, 0.5)},
           {"p90_dist_m", quantile(all, 0.9)},
           {"inlier_rms_m", inliers.empty() ? kNaN : std::sqrt(squares / count(inliers.size()))},
           {"inlier_median_m", quantile(inliers, 0.5)},
           {"corr_scan_to_map", all.empty() ? 0.0 : kernels / count(all.size())}}};
}

ScoreGroup scoreCells(const std::vector<Eigen::Vector2d>& keyframe_points, std::size_t keyframes,
                      const SegmentIndex& index, const LogScoreParameters& p, double& cell_nats) {
  const Cells cells = stableCells(keyframe_points, p.cell);
  std::vector<double> all, linear;
  cell_nats = 0.0;
  for (std::size_t i = 0; i < cells.centroid.size(); ++i) {
    all.push_back(index.nearest(cells.centroid[i], kFarthest).distance);
    if (!cells.linear[i]) continue;
    linear.push_back(all.back());
    cell_nats += std::min(0.5 * std::pow(all.back() / p.smear, 2), kNatsPerCell);
  }
  return {"cells",
          {{"cell_m", p.cell},
           {"keyframes", count(keyframes)},
           {"stable", count(all.size())},
           {"linear", count(linear.size())},
           {"linear_frac", all.empty() ? 0.0 : count(linear.size()) / count(all.size())},
           {"explained_05", shareWithin(all, 0.05)},
           {"explained_10", shareWithin(all, 0.10)},
           {"linear_explained_05", shareWithin(linear, 0.05)},
           {"linear_explained_10", shareWithin(linear, 0.10)},
           {"linear_median_dist_m", quantile(linear, 0.5)}}};
}

ScoreGroup scorePhantoms(const MapSamples& samples, const std::vector<Eigen::Vector2d>& all,
                         const std::vector<Eigen::Vector2d>& keyframe_points, double step,
                         const LogScoreParameters& p, std::vector<bool>& unsupported) {
  const PointIndex points(all), keyframe_index(keyframe_points);
  unsupported.assign(samples.size(), false);
  double total = 0.0, beyond_10 = 0.0, beyond_20 = 0.0, weak = 0.0, kernels = 0.0;
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double d = points.nearestDistance(samples.xy[k], kFarthest), w = samples.length[k];
    unsupported[k] = d > 0.10;
    keyframe_index.within(samples.xy[k], 0.10, near);
    total += w;
    beyond_10 += d > 0.10 ? w : 0.0;
    beyond_20 += d > 0.20 ? w : 0.0;
    weak += near.size() < 3 ? w : 0.0;
    kernels += w * kernel(d, p.smear);
  }
  const double runs = unsupportedRuns(samples, unsupported);
  const double scale = total > 0.0 ? 1.0 / total : 0.0;
  return {"phantom",
          {{"sample_step_m", step},
           {"frac_10", beyond_10 * scale},
           {"frac_20", beyond_20 * scale},
           {"frac_run50", runs * scale},
           {"weak_frac", weak * scale},
           {"length_10_m", beyond_10},
           {"length_run50_m", runs},
           {"corr_map_to_scan", kernels * scale}}};
}

ScoreGroup scoreMap(const std::vector<Segment2>& map, double total) {
  std::vector<double> lengths;
  for (const auto& s : map) lengths.push_back(s.length());
  const auto under = static_cast<std::size_t>(
      std::count_if(lengths.begin(), lengths.end(), [](double l) { return l < 0.5; }));
  return {
      "map",
      {{"segments", count(map.size())},
       {"total_length_m", total},
       {"median_segment_m", map.empty() ? 0.0 : quantile(lengths, 0.5)},
       {"longest_segment_m", map.empty() ? 0.0 : *std::max_element(lengths.begin(), lengths.end())},
       {"segments_under_0.5m", count(under)}}};
}

ScoreGroup scoreBias(const LateralBias& bias) {
  return {"bias",
          {{"stations", count(bias.stations)},
           {"rms_m", bias.rms},
           {"p95_m", bias.p95},
           {"spread_median_m", bias.spread_median}}};
}

ScoreGroup scoreRedundancy(const Redundancy& redundant, double length) {
  return {"redundancy",
          {{"redundant_frac_05", redundant.fraction_05},
           {"redundant_frac_10", redundant.fraction_10},
           {"multiplicity_10", redundant.multiplicity},
           {"dedup_length_m", redundant.dedup_length},
           {"ratio_10", length > 0.0 ? length / redundant.dedup_length : kNaN},
           {"joinable_pairs", count(redundant.joinable_pairs)}}};
}

ScoreGroup scoreFreeSpace(const FreeSpace& rays, const MapSamples& samples, double length) {
  double contradicted = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (rays.contradicted[k]) contradicted += samples.length[k];
  }
  const double scale = 1.0 / std::max(1.0, count(rays.rays));
  return {"free_space",
          {{"scans_used", count(rays.scans_used)},
           {"rays", count(rays.rays)},
           {"violating_rays_frac", count(rays.violating) * scale},
           {"violating_rays_robust_frac", count(rays.violating_robust) * scale},
           {"crossings_per_100_rays", 100.0 * count(rays.crossings) * scale},
           {"contradicted_frac", length > 0.0 ? contradicted / length : 0.0},
           {"contradicted_length_m", contradicted}}};
}

ScoreGroup scoreSize(const EndPoints& ends, std::size_t segments, const LogScoreParameters& p) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(kNaN), high = low;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends.range[i] > p.range_max) continue;
    low = low.x() == low.x() ? Eigen::Vector2d(low.cwiseMin(ends.xy[i])) : ends.xy[i];
    high = high.x() == high.x() ? Eigen::Vector2d(high.cwiseMax(ends.xy[i])) : ends.xy[i];
  }
  const Eigen::Vector2d cells = ((high - low) / 0.05).array().ceil() + 1.0;
  const double map_bytes = 16.0 * count(segments), grid_bytes = cells.x() * cells.y();
  return {"size",
          {{"map_bytes_float32", map_bytes},
           {"grid_bytes_5cm", grid_bytes},
           {"compression", segments ? grid_bytes / map_bytes : kNaN}}};
}

}  // namespace cca::log_score
