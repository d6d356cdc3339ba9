// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/main_directions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cca {
namespace {

constexpr double kQuarter = 0.5 * M_PI;  // rad: walls stand square to each other

/// rad, [-pi / 4, pi / 4): from one angle to another, quarter turns apart.
double turnTo(double from, double to) { return std::remainder(to - from, kQuarter); }

double angleOf(const LineSegment& segment) {
  const Eigen::Vector2d along = segment.direction();
  return std::fmod(std::atan2(along.y(), along.x()) + 2.0 * M_PI, kQuarter);
}

/// How many of their deviations two directions differ by.
double difference(const MainDirection& a, const MainDirection& b) {
  return std::abs(turnTo(a.angle, b.angle)) / std::sqrt(a.variance + b.variance);
}

/// The weighted mean of both.
MainDirection joined(const MainDirection& a, const MainDirection& b) {
  const double share = a.variance / (a.variance + b.variance);
  MainDirection both;
  both.angle = std::fmod(a.angle + share * turnTo(a.angle, b.angle) + kQuarter, kQuarter);
  both.variance = share * b.variance;
  return both;
}

}  // namespace

std::vector<MainDirection> mainDirections(const std::vector<MapLine>& lines,
                                          const DirectionTuning& tuning) {
  std::vector<MainDirection> all;
  for (const MapLine& line : lines) {
    const double variance = line.segment.covariance(1, 1);
    if (variance > 0.0 && std::isfinite(variance)) all.push_back({angleOf(line.segment), variance});
  }
  const auto byAngle = [](const MainDirection& a, const MainDirection& b) {
    return a.angle < b.angle;
  };
  std::stable_sort(all.begin(), all.end(), byAngle);
  while (all.size() > 1) {
    std::size_t best = 0;
    double least = tuning.deviations;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double d = difference(all[k], all[(k + 1) % all.size()]);
      if (d >= least) continue;
      least = d;
      best = k;
    }
    if (least >= tuning.deviations) break;
    const std::size_t next = (best + 1) % all.size();
    all[best] = joined(all[best], all[next]);
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(next));
  }
  std::stable_sort(all.begin(), all.end(), byAngle);
  return all;
}

std::vector<MapLine> alongMainDirections(std::vector<MapLine> lines,
                                         const std::vector<MainDirection>& directions,
                                         const DirectionTuning& tuning) {
  for (MapLine& line : lines) {
    LineSegment& segment = line.segment;
    const double angle = angleOf(segment);
    const double most = tuning.deviations * std::sqrt(segment.covariance(1, 1));
    double turn = 0.0, least = std::numeric_limits<double>::infinity();
    for (const MainDirection& direction : directions) {
      const double to = turnTo(angle, direction.angle);
      if (!(std::abs(to) <= most) || direction.variance >= least) continue;
      least = direction.variance;
      turn = to;
    }
    if (turn == 0.0) continue;
    const Eigen::Vector2d middle = 0.5 * (segment.start + segment.end);
    const Eigen::Rotation2Dd rotation(turn);
    segment.start = middle + rotation * (segment.start - middle);
    segment.end = middle + rotation * (segment.end - middle);
  }
  return lines;
}

}  // namespace cca
