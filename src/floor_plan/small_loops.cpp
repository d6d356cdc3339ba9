// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>

#include "floor_plan/region_outline.hpp"
#include "floor_plan/room_outline.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kSamePoint = 2e-4;       // m; files round to half of it
constexpr double kNearlyParallel = 1e-9;  // sine; beyond it rounding decides where two lines meet
constexpr double kSpike = -0.9995;        // cosine; a turn by more is a way there and back

/// Where two segments cross or touch; nothing of parallel ones.
std::optional<Eigen::Vector2d> crossing(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1,
                                        const Eigen::Vector2d& b0, const Eigen::Vector2d& b1) {
  const Eigen::Vector2d a = a1 - a0, b = b1 - b0;
  const double sine = cross(a, b);
  if (std::abs(sine) < kNearlyParallel * a.norm() * b.norm()) return std::nullopt;
  const double s = cross(Eigen::Vector2d(b0 - a0), b) / sine;
  const double t = cross(Eigen::Vector2d(b0 - a0), a) / sine;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return std::nullopt;
  return a0 + s * a;
}

/// Takes out one corner that is double, or the tip of a spike. @return  whether there was one.
bool dropCorner(Polygon& ring) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n && n > 3; ++k) {
    const Eigen::Vector2d in = ring[k] - ring[(k + n - 1) % n], out = ring[(k + 1) % n] - ring[k];
    const bool is_double = out.norm() < kSamePoint;
    if (!is_double && (in.norm() < kSamePoint || in.normalized().dot(out.normalized()) > kSpike))
      continue;
    ring.erase(ring.begin() + static_cast<long>(k));
    return true;
  }
  return false;
}

/// Cuts one loop of few corners off where the ring crosses itself. @return  whether there was one.
bool cutLoop(Polygon& ring, std::size_t most_corners) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j <= i + most_corners && j + 2 <= i + n; ++j) {
      const auto x = crossing(ring[i], ring[(i + 1) % n], ring[j % n], ring[(j + 1) % n]);
      if (!x) continue;
      Polygon left;
      for (std::size_t k = j + 1; k <= i + n; ++k) left.push_back(ring[k % n]);
      left.push_back(*x);
      Polygon loop{*x};
      for (std::size_t k = i + 1; k <= j; ++k) loop.push_back(ring[k % n]);
      if (std::abs(signedArea(loop)) > std::abs(signedArea(left))) continue;
      ring.swap(left);
      return true;
    }
  }
  return false;
}

}  // namespace

Polygon withoutSmallLoops(Polygon ring, std::size_t most_corners) {
  // Each step takes at least one corner away.
  while (ring.size() > 3 && (dropCorner(ring) || cutLoop(ring, most_corners))) {
  }
  return ring;
}

}  // namespace cca
