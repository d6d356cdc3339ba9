// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/laser.hpp"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/beam.hpp"

namespace cca {

namespace {

constexpr double kNoReturn = std::numeric_limits<double>::infinity();
constexpr double kInvalid = std::numeric_limits<double>::quiet_NaN();

std::vector<double> castExact(const World& world, const std::function<LaserPlace(double)>& at,
                              const Scan& scan, const LaserParameters& parameters, Random& random) {
  std::vector<double> ranges;
  ranges.reserve(parameters.beams);
  const double gaps = std::max(1.0, parameters.beams - 1.0);
  for (int beam = 0; beam < parameters.beams; ++beam) {
    const auto [T_map_sensor, bodies] = at(parameters.sweep * (beam / gaps - 0.5));
    double bearing = T_map_sensor.theta + scan.bearing(beam);
    if (parameters.angle_noise_deg > 0.0) {
      bearing += random.normal() * parameters.angle_noise_deg * M_PI / 180.0;
    }
    const Eigen::Vector2d p_map = T_map_sensor.position();
    double range = castBeam(world, p_map, bearing, parameters.range);
    for (const Body& body : bodies) range = std::min(range, castBeam(body, p_map, bearing));
    ranges.push_back(range);
  }
  return ranges;
}

/// MRPT's own simulator; without its noise, which comes from a global generator.
std::vector<double> castByMrpt(const World& world, const Scan& scan,
                               const LaserParameters& parameters) {
  mrpt::obs::CObservation2DRangeScan observation;
  observation.aperture = static_cast<float>(parameters.field_of_view_deg * M_PI / 180.0);
  observation.maxRange = static_cast<float>(parameters.range);
  observation.rightToLeft = true;
  const Eigen::Vector2d p_grid = scan.T_map_sensor.position() - world.origin();
  world.grid().laserScanSimulator(observation, {p_grid.x(), p_grid.y(), scan.T_map_sensor.theta},
                                  0.5f, parameters.beams);
  std::vector<double> ranges;
  for (int beam = 0; beam < parameters.beams; ++beam) {
    const double range = observation.getScanRange(beam);
    ranges.push_back(observation.getScanRangeValidity(beam) ? range : kNoReturn);
  }
  return ranges;
}

double withNoise(double range, const LaserParameters& parameters, Random& random) {
  if (parameters.dropout > 0.0 && random.uniform() < parameters.dropout) return kInvalid;
  if (!std::isfinite(range)) return range;
  if (range <= 0.0) return kInvalid;
  const double sigma = std::hypot(parameters.range_noise, parameters.range_noise_share * range);
  if (sigma > 0.0) range += random.normal() * sigma;
  if (range > parameters.range) return kNoReturn;
  return range > 0.0 ? range : kInvalid;
}

/// As the driver writes it.
double written(double range, const LaserParameters& parameters) {
  if (isReturn(range)) return range;
  switch (parameters.missing) {
    case MissingReading::kInfinity:
      return kNoReturn;
    case MissingReading::kZero:
      return 0.0;
    case MissingReading::kRangeMax:
      return parameters.range;
    default:
      return range;
  }
}

}  // namespace

double castBeam(const World& world, const Eigen::Vector2d& p_map, double bearing,
                double max_range) {
  return walkBeam(world, p_map, bearing, max_range, [](int) {});
}

Scan sweep(const World& world, const std::vector<Body>& bodies, const Pose2& T_map_sensor,
           const LaserParameters& parameters, Random& random) {
  const auto there = [&](double) { return LaserPlace{T_map_sensor, bodies}; };
  return sweep(world, there, parameters, random);
}

Scan sweep(const World& world, const std::function<LaserPlace(double)>& at,
           const LaserParameters& parameters, Random& random) {
  Scan scan;
  const double field_of_view = parameters.field_of_view_deg * M_PI / 180.0;
  scan.angle_min = parameters.beams > 1 ? -0.5 * field_of_view : 0.0;
  scan.angle_increment = parameters.beams > 1 ? field_of_view / (parameters.beams - 1) : 0.0;
  scan.free_range_without_return = parameters.range;
  scan.sweep_duration = std::abs(parameters.sweep);
  scan.T_map_sensor = at(0.0).T_map_sensor;
  scan.ranges = parameters.caster == Caster::kMrpt ? castByMrpt(world, scan, parameters)
                                                   : castExact(world, at, scan, parameters, random);
  if (parameters.caster == Caster::kMrpt)
    scan.free_range_without_return *= 0.8;  // it looks no farther
  for (double& range : scan.ranges) {
    range = written(withNoise(range, parameters, random), parameters);
  }
  return scan;
}

}  // namespace cca
