// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/log_score.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "log_score_parts.hpp"

namespace cca {
namespace {

using namespace log_score;

constexpr double kNatsPerSegment = 27.6;    // four coordinates of log(1000): 20 m at 2 cm
constexpr std::size_t kMostTested = 50000;  // samples tested for redundancy
constexpr double kMostSamples = 400000.0;

double harmonicMean(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

double totalLength(const std::vector<Segment2>& segments) {
  double total = 0.0;
  for (const auto& s : segments) total += s.length();
  return total;
}

/// What the lines are held against: returns within range_max, m, map frame.
struct Returns {
  std::vector<Eigen::Vector2d> all, of_keyframes, keyframe_origins;
  std::size_t keyframes = 0;
};

Returns returnsToJudgeBy(const std::vector<Scan>& scans, const EndPoints& ends,
                         const LogScoreParameters& p) {
  const std::vector<bool> is_keyframe = keyframes(scans);
  Returns returns;
  returns.keyframes =
      static_cast<std::size_t>(std::count(is_keyframe.begin(), is_keyframe.end(), true));
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends.range[i] > p.range_max) continue;
    returns.all.push_back(ends.xy[i]);
    if (!is_keyframe[ends.scan[i]]) continue;
    returns.of_keyframes.push_back(ends.xy[i]);
    returns.keyframe_origins.push_back(scans[ends.scan[i]].T_map_sensor.position());
  }
  return returns;
}

/// At most kMostTested of the samples, evenly.
std::vector<std::size_t> thinnedOut(const MapSamples& samples) {
  std::vector<std::size_t> picked;
  const std::size_t stride =
      std::max<std::size_t>(1, (samples.size() + kMostTested - 1) / kMostTested);
  for (std::size_t k = 0; k < samples.size(); k += stride) picked.push_back(k);
  return picked;
}

/// Share of the tested length that is supported and not contradicted, a sample beside n parallel
/// segments counting 1 / (1 + n).
double cleanShare(const MapSamples& samples, const std::vector<std::size_t>& tested,
                  const std::vector<bool>& unsupported, const FreeSpace& rays,
                  const Redundancy& redundant) {
  double clean = 0.0, length = 0.0;
  for (const std::size_t k : tested) {
    length += samples.length[k];
    if (unsupported[k] || rays.contradicted[k]) continue;
    clean += samples.length[k] / (1.0 + count(redundant.neighbours[k]));
  }
  return length > 0.0 ? clean / length : 0.0;
}

/// The figures to read first, from those of the other groups.
ScoreGroup scoreSummary(const LogScore& score, double clean, double cell_nats) {
  const double segments = score.at("map").at("segments");
  const double length = score.at("map").at("total_length_m");
  const double dedup_length = score.at("redundancy").at("dedup_length_m");
  const double linear_cells = score.at("cells").at("linear");
  const double recall = score.at("cells").at("linear_explained_10");
  const double scan_to_map = score.at("points").at("corr_scan_to_map");
  const double map_to_scan = score.at("phantom").at("corr_map_to_scan");
  const double nats = kNatsPerSegment * segments + cell_nats;
  return {
      "summary",
      {{"precision_clean_length", clean},
       {"recall_linear_cells_10", recall},
       {"f_score", harmonicMean(clean, recall)},
       {"corr_f", harmonicMean(scan_to_map, map_to_scan)},
       {"clean_length_m", clean * length},
       {"mdl_ratio", linear_cells > 0.0 ? nats / (kNatsPerCell * linear_cells) : kNaN},
       {"segments", segments},
       {"total_length_m", length},
       {"segments_per_100m_dedup", dedup_length > 0.0 ? 100.0 * segments / dedup_length : kNaN}}};
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
  const std::vector<Segment2> map = withLength(whole_map);
  const double length = totalLength(map);
  const EndPoints ends = endPoints(scans);
  if (ends.size() == 0) throw std::runtime_error("the log holds no laser return to judge a map by");
  const Returns returns = returnsToJudgeBy(scans, ends, p);
  const SegmentIndex index(map);
  const double step = std::max(p.step, length / kMostSamples);
  const MapSamples samples = sampleMap(map, step);
  const std::vector<std::size_t> tested = thinnedOut(samples);
  const Redundancy redundant =
      redundancy(map, index, samples, tested, returns.of_keyframes, returns.keyframe_origins);
  const FreeSpace rays = freeSpace(scans, map, samples, p);

  LogScore score;
  double cell_nats = 0.0;
  std::vector<bool> unsupported;
  score.groups = {scoreMap(map, length),
                  scorePoints(ends, index, p),
                  scoreCells(returns.of_keyframes, returns.keyframes, index, p, cell_nats),
                  scorePhantoms(samples, ends.xy, returns.of_keyframes, step, p, unsupported),
                  scoreBias(lateralBias(returns.all, map, index)),
                  scoreRedundancy(redundant, length),
                  scoreFreeSpace(rays, samples, length),
                  scoreSize(ends, map.size(), p)};
  const double clean = cleanShare(samples, tested, unsupported, rays, redundant);
  score.groups.push_back(scoreSummary(score, clean, cell_nats));
  return score;
}

}  // namespace cca
