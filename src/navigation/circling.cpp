// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/circling.hpp"

#include <cmath>

namespace cca {
namespace {

constexpr double kSpacing = 0.1;      // m, between remembered places
constexpr double kTolerance = 0.2;    // m, below the robot's width: not the wall's other side
constexpr double kLeastLength = 1.0;  // m, less than once around a single point
constexpr double kTurnTolerance =
    0.8;  // rad, of the whole turn; the boundary is seen anew each time

}  // namespace

void Circling::add(const Eigen::Vector2d& p_map, double length, double heading) {
  for (const Place& place : places_) {
    const double turned = std::abs(heading - place.heading);
    closed_ = closed_ || (length - place.length >= kLeastLength &&
                          std::abs(turned - 2.0 * M_PI) <= kTurnTolerance &&
                          (p_map - place.p_map).norm() <= kTolerance);
  }
  if (places_.empty() || length - places_.back().length >= kSpacing) {
    places_.push_back({p_map, length, heading});
  }
}

}  // namespace cca
