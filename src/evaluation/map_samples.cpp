// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "log_score_parts.hpp"

namespace cca::log_score {
namespace {

constexpr double kShortest = 1e-6;  // m
constexpr double kKeyframeDistance = 0.5, kKeyframeTurn = 20.0 * M_PI / 180.0;
constexpr double kNeighbourhood = 0.30, kThickness = 0.05, kSpread = 0.10;
constexpr std::size_t kFewestCells = 6;

/// Weighted moments of the cells around one cell, taken from its centroid.
bool isThinLine(const Cells& cells, std::size_t i, const std::vector<std::size_t>& near) {
  if (near.size() < kFewestCells) return false;
  double sum = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const std::size_t j : near) {
    const Eigen::Vector2d d = cells.centroid[j] - cells.centroid[i];
    sum += cells.hits[j];
    mean += cells.hits[j] * d;
    square += cells.hits[j] * d * d.transpose();
  }
  mean /= sum;
  const Eigen::Matrix2d s = square / sum - mean * mean.transpose();
  const double middle = 0.5 * (s(0, 0) + s(1, 1));
  const double swing = std::hypot(0.5 * (s(0, 0) - s(1, 1)), s(0, 1));
  return std::sqrt(std::max(middle - swing, 0.0)) <= kThickness &&
         std::sqrt(middle + swing) >= kSpread;
}

}  // namespace

std::vector<Segment2> withLength(const std::vector<Segment2>& segments) {
  std::vector<Segment2> kept;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(kept),
               [](const Segment2& s) { return s.length() > kShortest; });
  return kept;
}

EndPoints endPoints(const std::vector<Scan>& scans) {
  EndPoints ends;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const Scan& scan = scans[k];
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (!counts(scan.ranges[i])) continue;
      const double theta = scan.bearing(i) + scan.T_map_sensor.theta;
      ends.xy.push_back(scan.T_map_sensor.position() +
                        scan.ranges[i] * Eigen::Vector2d(std::cos(theta), std::sin(theta)));
      ends.range.push_back(scan.ranges[i]);
      ends.scan.push_back(k);
    }
  }
  return ends;
}

MapSamples sampleMap(const std::vector<Segment2>& map, double step) {
  MapSamples samples;
  for (std::size_t s = 0; s < map.size(); ++s) {
    const double length = map[s].length();
    const auto bins = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step - 1e-9)));
    samples.first.push_back(samples.size());
    samples.count.push_back(bins);
    for (std::size_t k = 0; k < bins; ++k) {
      const double f = (static_cast<double>(k) + 0.5) / static_cast<double>(bins);
      samples.xy.push_back(map[s].start + f * (map[s].end - map[s].start));
      samples.segment.push_back(s);
      samples.length.push_back(length / static_cast<double>(bins));
    }
  }
  return samples;
}

std::vector<bool> keyframes(const std::vector<Scan>& scans) {
  std::vector<bool> keep(scans.size(), false);
  std::size_t last = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Pose2 &pose = scans[i].T_map_sensor, &kept = scans[last].T_map_sensor;
    keep[i] = i == 0 || std::abs(wrapAngle(pose.theta - kept.theta)) >= kKeyframeTurn ||
              (pose.position() - kept.position()).norm() >= kKeyframeDistance;
    if (keep[i]) last = i;
  }
  return keep;
}

Cells stableCells(const std::vector<Eigen::Vector2d>& points, double cell) {
  struct Sum {
    Eigen::Vector2d xy = Eigen::Vector2d::Zero();
    double count = 0.0;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, Sum> sums;
  for (const auto& p : points) {
    Sum& sum = sums[{static_cast<std::int64_t>(std::floor(p.x() / cell)),
                     static_cast<std::int64_t>(std::floor(p.y() / cell))}];
    sum.xy += p;
    sum.count += 1.0;
  }
  Cells cells;
  for (const auto& [key, sum] : sums) {
    if (sum.count < 2.0) continue;
    cells.centroid.push_back(sum.xy / sum.count);
    cells.hits.push_back(sum.count);
  }
  const PointIndex index(cells.centroid);
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < cells.centroid.size(); ++i) {
    index.within(cells.centroid[i], kNeighbourhood, near);
    cells.linear.push_back(isThinLine(cells, i, near));
  }
  return cells;
}

double ranked(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank =
      std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                   values.end());
  return values[rank];
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

double shareWithin(const std::vector<double>& values, double limit) {
  if (values.empty()) return 0.0;
  const auto within =
      std::count_if(values.begin(), values.end(), [limit](double v) { return v <= limit; });
  return static_cast<double>(within) / static_cast<double>(values.size());
}

}  // namespace cca::log_score
