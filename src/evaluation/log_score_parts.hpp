// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "evaluation/log_score.hpp"

/// The parts of scoreAgainstLog(), each in a file of its own.
namespace cca::log_score {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Segments of a micrometre and more: shorter ones count nowhere.
std::vector<Segment2> withLength(const std::vector<Segment2>& segments);

/// Returns of the log in the map frame, scan by scan.
struct EndPoints {
  std::vector<Eigen::Vector2d> xy;  ///< m
  std::vector<double> range;        ///< m
  std::vector<std::size_t> scan;    ///< number of the scan

  std::size_t size() const { return xy.size(); }
};

EndPoints endPoints(const std::vector<Scan>& scans);

/// Mid points of equal bins along each segment of the map.
struct MapSamples {
  std::vector<Eigen::Vector2d> xy;
  std::vector<std::size_t> segment;
  std::vector<double> length;      ///< m, of the sample's bin
  std::vector<std::size_t> first;  ///< a segment's first sample
  std::vector<std::size_t> count;  ///< a segment's number of samples

  std::size_t size() const { return xy.size(); }
};

MapSamples sampleMap(const std::vector<Segment2>& map, double step);

/// Scans at least 0.5 m or 20 degrees apart, so that dense logs weigh like sparse ones.
std::vector<bool> keyframes(const std::vector<Scan>& scans);

/// Occupied cells with at least two points: centroids and whether their surroundings are a thin
/// line.
struct Cells {
  std::vector<Eigen::Vector2d> centroid;
  std::vector<double> hits;
  std::vector<bool> linear;
};

Cells stableCells(const std::vector<Eigen::Vector2d>& points, double cell);

/// Signed offset of end points from the line, median per 0.25 m of map.
struct LateralBias {
  std::size_t stations = 0;
  double rms = 0.0, p95 = 0.0, spread_median = 0.0;  ///< m; NaN without stations
};

LateralBias lateralBias(const std::vector<Eigen::Vector2d>& points,
                        const std::vector<Segment2>& map, const SegmentIndex& index);

/// Length of map that runs beside other map.
struct Redundancy {
  double fraction_05 = 0.0, fraction_10 = 0.0, multiplicity = 0.0, dedup_length = 0.0;
  std::size_t joinable_pairs = 0;
  std::vector<std::size_t> neighbours;  ///< per sample, parallel segments within 10 cm
};

/// @param points, origins  keyframe end points and where they were seen from.
/// @param picked  samples to test.
Redundancy redundancy(const std::vector<Segment2>& map, const SegmentIndex& index,
                      const MapSamples& samples, const std::vector<std::size_t>& picked,
                      const std::vector<Eigen::Vector2d>& points,
                      const std::vector<Eigen::Vector2d>& origins);

/// Rays that cross the map before their end point.
struct FreeSpace {
  std::size_t scans_used = 0, rays = 0, violating = 0, violating_robust = 0, crossings = 0;
  std::vector<bool> contradicted;  ///< per sample
};

FreeSpace freeSpace(const std::vector<Scan>& scans, const std::vector<Segment2>& map,
                    const MapSamples& samples, const LogScoreParameters& parameters);

/// Value of rank floor(q n) of an unsorted list; NaN where it is empty.
double ranked(std::vector<double> values, double q);
/// The same, linear between ranks q (n - 1); NaN where the list is empty.
double quantile(std::vector<double> values, double q);
/// Share of the values at or below a limit; 0 where there are none.
double shareWithin(const std::vector<double>& values, double limit);

/// Distance of a scan's beam that counts as a return here.
inline bool counts(double range) { return isReturn(range) && range >= 0.05; }

inline double count(std::size_t n) { return static_cast<double>(n); }

constexpr double kNatsPerCell = 4.5;  ///< a linear cell that no segment tells: three deviations

// The groups of figures, named as docs/evaluation.md has them.
ScoreGroup scorePoints(const EndPoints& ends, const SegmentIndex& index,
                       const LogScoreParameters& p);
/// Also gives the description length of the linear cells, without the segments' part.
ScoreGroup scoreCells(const std::vector<Eigen::Vector2d>& keyframe_points, std::size_t keyframes,
                      const SegmentIndex& index, const LogScoreParameters& p, double& cell_nats);
/// Also tells which samples have no end point within 10 cm.
ScoreGroup scorePhantoms(const MapSamples& samples, const std::vector<Eigen::Vector2d>& all,
                         const std::vector<Eigen::Vector2d>& keyframe_points, double step,
                         const LogScoreParameters& p, std::vector<bool>& unsupported);
ScoreGroup scoreMap(const std::vector<Segment2>& map, double total);
ScoreGroup scoreBias(const LateralBias& bias);
ScoreGroup scoreRedundancy(const Redundancy& redundant, double length);
ScoreGroup scoreFreeSpace(const FreeSpace& rays, const MapSamples& samples, double length);
ScoreGroup scoreSize(const EndPoints& ends, std::size_t segments, const LogScoreParameters& p);

}  // namespace cca::log_score
