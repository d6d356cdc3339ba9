// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "slam/scan_surface.hpp"

namespace cca {

/// A rigid motion in single precision, with its sine and cosine taken once.
struct PackedMotion {
  explicit PackedMotion(const Pose2& pose)
      : c(static_cast<float>(std::cos(pose.theta))),
        s(static_cast<float>(std::sin(pose.theta))),
        x(static_cast<float>(pose.x)),
        y(static_cast<float>(pose.y)) {}
  float c, s, x, y;
};

/// Points of one surface in the frame of another, the viewer, and the beam of the viewer that looks
/// at each: -1 where none does. All points are taken at once, by loops that the compiler can
/// vectorise: a third of the time of ScanSurface::beamTowards() for each.
struct SeenPoints {
  SeenPoints(const PackedPoints& points, const PackedMotion& T_viewer_points,
             const ScanSurface& viewer);

  std::vector<float> x, y;  ///< m, frame of the viewer
  std::vector<std::int32_t> beam;
};

}  // namespace cca
