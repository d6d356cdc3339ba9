// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/evaluation/log_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "log_score_parts.hpp"

namespace cca {
namespace {

using log_score::EndPoints;
using log_score::MapSamples;
using log_score::quantile;
using log_score::shareWithin;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnsupportedRun = 0.5;     // m
constexpr double kFarthest = 1.0;           // m, distances are capped here
constexpr double kNatsPerSegment = 27.6;    // four coordinates of log(1000): 20 m at 2 cm
constexpr double kNatsPerCell = 4.5;        // three standard deviations
constexpr std::size_t kMostTested = 50000;  // samples tested for redundancy
constexpr double kMostSamples = 400000.0;

double count(std::size_t n) { return static_cast<double>(n); }

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

double harmonicMean(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

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

/// Also gives the description length of the linear cells, without the segments' part.
ScoreGroup scoreCells(const std::vector<Eigen::Vector2d>& keyframe_points, std::size_t keyframes,
                      const SegmentIndex& index, const LogScoreParameters& p, double& cell_nats) {
  const log_score::Cells cells = log_score::stableCells(keyframe_points, p.cell);
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

}  // namespace

double ScoreGroup::at(const std::string& figure) const {
  for (const auto& [key, value] : figures) {
    if (key == figure) return value;
  }
  throw std::out_of_range("no figure " + figure + " in " + name);
}

const ScoreGroup& LogScore::at(const std::string& group) const {
  for (const auto& g : groups) {
    if (g.name == group) return g;
  }
  throw std::out_of_range("no group " + group);
}

LogScore scoreAgainstLog(const std::vector<Scan>& scans, const std::vector<Segment2>& whole_map,
                         const LogScoreParameters& p) {
  std::vector<Segment2> map;
  double total = 0.0;
  for (const auto& s : whole_map) {
    if (s.length() <= 1e-6) continue;
    map.push_back(s);
    total += s.length();
  }
  const EndPoints ends = log_score::endPoints(scans);
  if (ends.size() == 0) throw std::runtime_error("the log holds no laser return to judge a map by");
  const SegmentIndex index(map);
  const std::vector<bool> is_keyframe = log_score::keyframes(scans);
  std::vector<Eigen::Vector2d> evaluated, keyframe_points, keyframe_origins;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends.range[i] > p.range_max) continue;
    evaluated.push_back(ends.xy[i]);
    if (!is_keyframe[ends.scan[i]]) continue;
    keyframe_points.push_back(ends.xy[i]);
    keyframe_origins.push_back(scans[ends.scan[i]].T_map_sensor.position());
  }
  const double step = std::max(p.step, total / kMostSamples);
  const MapSamples samples = log_score::sampleMap(map, step);
  std::vector<std::size_t> picked;
  const std::size_t stride =
      std::max<std::size_t>(1, (samples.size() + kMostTested - 1) / kMostTested);
  for (std::size_t k = 0; k < samples.size(); k += stride) picked.push_back(k);

  LogScore score;
  double cell_nats = 0.0;
  std::vector<bool> unsupported;
  const auto keyframes =
      static_cast<std::size_t>(std::count(is_keyframe.begin(), is_keyframe.end(), true));
  score.groups = {scoreMap(map, total), scorePoints(ends, index, p),
                  scoreCells(keyframe_points, keyframes, index, p, cell_nats),
                  scorePhantoms(samples, ends.xy, keyframe_points, step, p, unsupported)};

  const auto bias = log_score::lateralBias(evaluated, map, index);
  score.groups.push_back({"bias",
                          {{"stations", count(bias.stations)},
                           {"rms_m", bias.rms},
                           {"p95_m", bias.p95},
                           {"spread_median_m", bias.spread_median}}});

  const auto redundant =
      log_score::redundancy(map, index, samples, picked, keyframe_points, keyframe_origins);
  score.groups.push_back({"redundancy",
                          {{"redundant_frac_05", redundant.fraction_05},
                           {"redundant_frac_10", redundant.fraction_10},
                           {"multiplicity_10", redundant.multiplicity},
                           {"dedup_length_m", redundant.dedup_length},
                           {"ratio_10", map.empty() ? kNaN : total / redundant.dedup_length},
                           {"joinable_pairs", count(redundant.joinable_pairs)}}});

  const auto rays = log_score::freeSpace(scans, map, samples, p);
  double contradicted = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (rays.contradicted[k]) contradicted += samples.length[k];
  }
  const double ray_scale = 1.0 / std::max(1.0, count(rays.rays));
  score.groups.push_back({"free_space",
                          {{"scans_used", count(rays.scans_used)},
                           {"rays", count(rays.rays)},
                           {"violating_rays_frac", count(rays.violating) * ray_scale},
                           {"violating_rays_robust_frac", count(rays.violating_robust) * ray_scale},
                           {"crossings_per_100_rays", 100.0 * count(rays.crossings) * ray_scale},
                           {"contradicted_frac", total > 0.0 ? contradicted / total : 0.0},
                           {"contradicted_length_m", contradicted}}});
  score.groups.push_back(scoreSize(ends, map.size(), p));

  double clean = 0.0, weight = 0.0;
  for (const std::size_t k : picked) {
    weight += samples.length[k];
    if (unsupported[k] || rays.contradicted[k]) continue;
    clean += samples.length[k] / (1.0 + count(redundant.neighbours[k]));
  }
  clean = weight > 0.0 ? clean / weight : 0.0;
  const double linear_cells = score.at("cells").at("linear");
  const double recall = score.at("cells").at("linear_explained_10");
  const double scan_to_map = score.at("points").at("corr_scan_to_map");
  const double map_to_scan = score.at("phantom").at("corr_map_to_scan");
  score.groups.push_back(
      {"summary",
       {{"precision_clean_length", clean},
        {"recall_linear_cells_10", recall},
        {"f_score", harmonicMean(clean, recall)},
        {"corr_f", harmonicMean(scan_to_map, map_to_scan)},
        {"clean_length_m", clean * total},
        {"mdl_ratio", linear_cells > 0.0 ? (kNatsPerSegment * count(map.size()) + cell_nats) /
                                               (kNatsPerCell * linear_cells)
                                         : kNaN},
        {"segments", count(map.size())},
        {"total_length_m", total},
        {"segments_per_100m_dedup", redundant.dedup_length > 0.0
                                        ? 100.0 * count(map.size()) / redundant.dedup_length
                                        : kNaN}}});
  return score;
}

}  // namespace cca
