// SPDX-License-Identifier: BSD-3-Clause
#include "slam/seen_points.hpp"

#include <cstddef>

namespace cca {
namespace {

/// rad; in single precision, as the bearings are.
constexpr float kTurn = 6.2831853F, kHalfTurn = 3.1415927F, kQuarterTurn = 1.5707963F;
/// m; keeps a point at the sensor from a division by zero, and moves no other.
constexpr float kAtSensor = 1e-12F;

float oneIf(bool is_so) { return is_so ? 1.0F : 0.0F; }

/// bearingOf() in single precision, without a branch.
float packedBearing(float x, float y) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
  const float z = smaller / (larger + kAtSensor), zz = z * z;
  float angle = z * (0.9998660F +
                     zz * (-0.3302995F + zz * (0.1801410F + zz * (-0.0851330F + zz * 0.0208351F))));
  angle += oneIf(ay > ax) * (kQuarterTurn - 2.0F * angle);
  angle += oneIf(x < 0.0F) * (kHalfTurn - 2.0F * angle);
  return std::copysign(angle, y);
}

}  // namespace

SeenPoints::SeenPoints(const PackedPoints& points, const PackedMotion& T, const ScanSurface& viewer)
    : x(points.x.size()), y(points.x.size()), beam(points.x.size()) {
  const std::size_t count = points.x.size();
  if (viewer.beams() == 0) {
    beam.assign(count, -1);
    return;
  }
  const float *from_x = points.x.data(), *from_y = points.y.data();
  float *at_x = x.data(), *at_y = y.data();
  std::int32_t* towards = beam.data();
  const float first = static_cast<float>(viewer.first_bearing);
  const float per_radian = static_cast<float>(1.0 / viewer.spacing);
  const float before_first = -0.5F * static_cast<float>(viewer.spacing);
  const std::int32_t beams = viewer.beams(), beside = viewer.is_full_turn ? 0 : -1;
  for (std::size_t k = 0; k < count; ++k) {
    at_x[k] = T.x + T.c * from_x[k] - T.s * from_y[k];
    at_y[k] = T.y + T.s * from_x[k] + T.c * from_y[k];
  }
  for (std::size_t k = 0; k < count; ++k) {
    float turn = packedBearing(at_x[k], at_y[k]) - first;
    turn += kTurn * oneIf(turn < before_first);
    turn += kTurn * oneIf(turn < before_first);
    turn -= kTurn * oneIf(turn >= kTurn + before_first);
    const auto at = static_cast<std::int32_t>(turn * per_radian + 0.5F);
    towards[k] = at < beams ? at : beside;
  }
}

}  // namespace cca
