// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/sigma_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cross.hpp"
#include "log_score_parts.hpp"

namespace cca {
namespace {

using namespace log_score;

/// m, that a line may go on beyond its true wall: its middle is asked, and a wall may be in pieces.
constexpr double kBeyond = 0.5;

double shareBeyond(const std::vector<double>& errors, double gate) {
  const auto beyond = std::count_if(errors.begin(), errors.end(),
                                    [gate](double error) { return std::abs(error) > gate; });
  return errors.empty() ? kNaN : static_cast<double>(beyond) / static_cast<double>(errors.size());
}

double medianMagnitude(std::vector<double> errors) {
  for (double& error : errors) error = std::abs(error);
  return ranked(errors, 0.5);
}

}  // namespace

ScoreGroup scoreSigmas(const std::vector<Segment2>& truth, const std::vector<MapLine>& map,
                       const SigmaScoreParameters& p) {
  constexpr double kTold = 3.0;  // deviations
  std::vector<double> offsets, angles;
  const double most_sine = std::sin(p.angle_tolerance_deg * M_PI / 180.0);
  for (const MapLine& line : map) {
    const LineSegment& s = line.segment;
    if (s.length() < p.least_length || !(s.covariance.diagonal().minCoeff() > 0.0)) continue;
    const Eigen::Vector2d u = s.direction(), middle = 0.5 * (s.start + s.end);
    double nearest = p.tolerance, offset = kNaN, sine = kNaN;
    for (const Segment2& wall : truth) {
      if (!(wall.length() > 0.0)) continue;
      Eigen::Vector2d d = (wall.end - wall.start) / wall.length();
      const double along = d.dot(middle - wall.start), across = cross(d, middle - wall.start);
      if (along < -kBeyond || along > wall.length() + kBeyond) continue;
      if (std::abs(across) > nearest || std::abs(cross(d, u)) > most_sine) continue;
      nearest = std::abs(across);
      offset = across;
      sine = cross(d, u);
    }
    if (std::isnan(offset)) continue;
    offsets.push_back(offset / std::sqrt(s.covariance(0, 0)));
    angles.push_back(std::asin(sine) / std::sqrt(s.covariance(1, 1)));
  }
  return {"sigmas",
          {{"lines", static_cast<double>(offsets.size())},
           {"offset_median", medianMagnitude(offsets)},
           {"offset_beyond_3", shareBeyond(offsets, kTold)},
           {"angle_median", medianMagnitude(angles)},
           {"angle_beyond_3", shareBeyond(angles, kTold)}}};
}

}  // namespace cca
