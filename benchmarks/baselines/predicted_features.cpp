// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/predicted_features.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "baselines/fitted_circle.hpp"

namespace cca::baselines {
namespace {

/// m, range at which the beam through a point meets a line; infinite where it does not.
double rangeOf(const FittedLine& line, const Eigen::Vector2d& beam) {
  const Eigen::Vector2d normal(-line.direction.y(), line.direction.x());
  const double range = normal.dot(line.centroid) / normal.dot(beam);
  return range > 0.0 ? range : INFINITY;
}

/// The same for the side of a circle that is nearer to the sensor.
double rangeOf(const FittedCircle& circle, const Eigen::Vector2d& beam) {
  const double along = beam.dot(circle.centre);
  const double within = along * along - circle.centre.squaredNorm() + circle.radius * circle.radius;
  return within >= 0.0 ? along - std::sqrt(within) : INFINITY;
}

/// Whether the return lies where the feature was expected.
template <class Feature>
bool isPredicted(const Feature& feature, const Eigen::Vector2d& point, double tolerance) {
  const double range = point.norm();
  return std::abs(rangeOf(feature, point / range) - range) <= tolerance;
}

/// How far a line through the run goes on.
Run growLine(const Points& points, Run run, double tolerance) {
  PointMoments moments = momentsOf(points, run);
  while (run.last < points.size() && isPredicted(fitLine(moments), points[run.last], tolerance)) {
    moments.add(points[run.last++]);
  }
  return run;
}

/// The same for a circle; the run itself where there is none.
Run growCircle(const Points& points, Run run, const PredictedFeaturesParameters& p) {
  for (std::optional<FittedCircle> circle = fitCircle(points, run);
       run.last < points.size() && circle && circle->radius <= p.largest_radius &&
       isPredicted(*circle, points[run.last], p.prediction);
       circle = fitCircle(points, run)) {
    ++run.last;
  }
  return run;
}

bool isSeed(const Points& points, Run run, double rms) {
  const PointMoments moments = momentsOf(points, run);
  return principalAxis(moments).residual_sum_sq <= rms * rms * moments.weight;
}

}  // namespace

PredictedFeaturesParameters PredictedFeaturesParameters::tuned() {
  return {{5, 0.10}, 4, 0.054, 0.13, 1.7};
}

std::vector<LineSegment> predictedFeatures(const Scan& scan, const PredictedFeaturesParameters& p) {
  const Points points = returnedPoints(scan);
  const auto seed_points = static_cast<std::size_t>(p.seed_points);
  std::vector<Run> lines;
  for (std::size_t first = 0; first + seed_points <= points.size();) {
    const Run seed{first, first + seed_points};
    if (!isSeed(points, seed, p.seed_rms)) {
      ++first;
      continue;
    }
    const Run line = growLine(points, seed, p.prediction);
    const Run circle = growCircle(points, seed, p);
    const bool is_round = circle.size() >= line.size() && isRound(points, circle, p.largest_radius);
    if (!is_round) lines.push_back(line);
    first = is_round ? circle.last : line.last;
  }
  return segmentsOf(points, lines, p.limits);
}

}  // namespace cca::baselines
