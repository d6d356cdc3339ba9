// SPDX-License-Identifier: BSD-3-Clause
//
// What the rays of one scan say of the returns of another.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "slam/seen_points.hpp"
#include "slam/surface_matching.hpp"

namespace cca {

SightCount& SightCount::operator+=(const SightCount& other) {
  agree += other.agree;
  contradict += other.contradict;
  unseen += other.unseen;
  return *this;
}

double SightCount::agreement() const {
  const double seen = agree + contradict;
  return seen > 0.0 ? agree / seen : 0.0;
}

namespace {

/// m, within which a ray ends at a return: what poses err by within a visit.
constexpr float kRaysAgree = 0.2F;

/// What the rays of a viewer say of points in its frame: 1, they stand where it had a return, or
/// could have had one; -1, it saw through; 0, it saw nothing of them.
std::vector<std::int8_t> sightsOf(const ScanSurface& viewer, const PackedPoints& points,
                                  const Pose2& T_viewer_points) {
  const SeenPoints seen(points, PackedMotion(T_viewer_points), viewer);
  std::vector<std::int8_t> sights(points.x.size(), 0);
  for (std::size_t k = 0; k < sights.size(); ++k) {
    if (seen.beam[k] < 0) continue;
    const auto beam = static_cast<std::size_t>(seen.beam[k]);
    const float range = std::sqrt(seen.x[k] * seen.x[k] + seen.y[k] * seen.y[k]);
    // Between the nearest and the farthest of three neighbouring beams a surface may lie anywhere.
    if (range <= viewer.least_free[beam] - kRaysAgree) {
      sights[k] = -1;
    } else if (range < viewer.most_free[beam] + kRaysAgree) {
      sights[k] = 1;
    }
  }
  return sights;
}

}  // namespace

SightCount compareSights(const ScanSurface& viewer, const ScanSurface& other,
                         const Pose2& T_viewer_other) {
  SightCount count;
  for (const std::int8_t sight : sightsOf(viewer, other.packed, T_viewer_other)) {
    count.agree += sight > 0;
    count.contradict += sight < 0;
    count.unseen += sight == 0;
  }
  return count;
}

void forgetWhatMoved(ScanSurface& surface, const Pose2& T_map_sensor,
                     const std::vector<PlacedSurface>& others) {
  std::vector<int> balance(surface.points.size(), 0);
  for (const PlacedSurface& other : others) {
    const auto sights =
        sightsOf(*other.surface, surface.packed, other.T_map_sensor.inverse() * T_map_sensor);
    for (std::size_t k = 0; k < sights.size(); ++k) balance[k] += sights[k];
  }
  for (std::size_t k = 0; k < balance.size(); ++k) {
    if (balance[k] < 0) surface.points[k].normal.setZero();
  }
  surface.pack();
}

}  // namespace cca
