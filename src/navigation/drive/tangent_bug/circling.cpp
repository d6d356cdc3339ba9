// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/circling.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kSpacing = 0.1;      // m, between remembered places
constexpr double kTolerance = 0.2;    // m, below the robot's width: not the wall's other side
constexpr double kLeastLength = 1.0;  // m, less than once around a single point
constexpr double kOverlap = 0.8;      // m, walked twice: seen from all of the loop
constexpr double kTurnTolerance =
    0.8;  // rad, of the whole turn; the boundary is seen anew each time

}  // namespace

void Circling::add(const Eigen::Vector2d& p_map, double length, double heading) {
  const bool again = std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    const double turned = std::abs(heading - place.heading);
    return length - place.length >= kLeastLength &&
           std::abs(turned - 2.0 * M_PI) <= kTurnTolerance &&
           (p_map - place.p_map).norm() <= kTolerance;
  });
  if (again && again_since_ < 0.0) again_since_ = length;
  if (!again) again_since_ = -1.0;
  closed_ = closed_ || (again && length - again_since_ >= kOverlap);
  if (places_.empty() || length - places_.back().length >= kSpacing) {
    places_.push_back({p_map, length, heading});
  }
}

}  // namespace cca
