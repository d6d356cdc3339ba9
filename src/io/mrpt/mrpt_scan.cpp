// SPDX-License-Identifier: BSD-3-Clause
#include "io/mrpt/mrpt_scan.hpp"

#include <mrpt/system/datetime.h>

#include <cmath>

#include "cca_mrpt/sensing/saturation.hpp"

namespace cca {
namespace {

constexpr double kSteepest = 0.966;  // cosine of 15 degrees: beyond, beams meet the floor
constexpr float kInvalidOfMaximum = 1e-3F;

double judged(double range, bool valid, double max_range) {
  const bool at_maximum = max_range > 0.0 && range >= kOfReach * max_range;
  if (at_maximum || (!valid && range == 0.0)) return HUGE_VAL;
  return valid && range > 0.0 ? range : 0.0;
}

}  // namespace

std::optional<MountedScan> fromMrpt(const mrpt::obs::CObservation2DRangeScan& observation) {
  const mrpt::math::CMatrixDouble33 R = observation.sensorPose.getRotationMatrix();
  const double upright = R(2, 2), aperture = observation.aperture;
  const std::size_t beams = observation.getScanSize();
  if (!(std::abs(upright) >= kSteepest) || beams < 2) return std::nullopt;
  if (!(aperture > 0.0 && aperture <= 2.1 * M_PI)) return std::nullopt;
  const double x = observation.sensorPose.x(), y = observation.sensorPose.y();
  if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;

  MountedScan mounted;
  mounted.T_robot_sensor = {x, y, std::atan2(R(1, 0), R(0, 0))};
  const bool counter_clockwise = observation.rightToLeft == (upright > 0.0);
  const double sign = counter_clockwise ? 1.0 : -1.0;
  mounted.scan.angle_min = -0.5 * sign * aperture;
  mounted.scan.angle_increment = sign * aperture / static_cast<double>(beams - 1);
  mounted.scan.ranges.reserve(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const double range = observation.getScanRange(beam);
    const bool valid = observation.getScanRangeValidity(beam);
    mounted.scan.ranges.push_back(judged(range, valid, observation.maxRange));
  }
  return mounted;
}

mrpt::obs::CObservation2DRangeScan toMrpt(const Scan& scan, const Pose2& T_robot_sensor,
                                          double max_range, std::optional<double> time) {
  mrpt::obs::CObservation2DRangeScan observation;
  observation.sensorLabel = "LASER";
  observation.timestamp = time ? mrpt::Clock::fromDouble(*time) : INVALID_TIMESTAMP;
  observation.resizeScan(scan.size());
  const double gaps = scan.size() > 1 ? static_cast<double>(scan.size() - 1) : 0.0;
  observation.aperture = static_cast<float>(std::abs(scan.angle_increment) * gaps);
  observation.rightToLeft = scan.angle_increment > 0.0;
  observation.maxRange = static_cast<float>(max_range);
  const double middle = scan.angle_min + 0.5 * gaps * scan.angle_increment;
  observation.sensorPose = mrpt::poses::CPose3D(T_robot_sensor.x, T_robot_sensor.y, 0.0,
                                                wrapAngle(T_robot_sensor.theta + middle), 0.0, 0.0);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = scan.ranges[beam];
    const float missing = (isNoReturn(range) ? 1.0F : kInvalidOfMaximum) * observation.maxRange;
    observation.setScanRangeValidity(beam, isReturn(range));
    observation.setScanRange(beam, isReturn(range) ? static_cast<float>(range) : missing);
  }
  return observation;
}

}  // namespace cca
