// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/wall.hpp"

#include <cmath>
#include <utility>

namespace cca {
namespace {

/// Rigid motion between two wall frames: t' = t0 + tt t + td d, d' = d0 + dt t + dd d.
struct FrameChange {
  double t0, d0, tt, td, dt, dd;

  FrameChange(const Wall& to, const Wall& from) {
    const Eigen::Vector2d shift = to.toWall(from.origin);
    t0 = shift.x();
    d0 = shift.y();
    tt = to.direction.dot(from.direction);
    dt = to.normal().dot(from.direction);
    td = -dt;
    dd = tt;
  }

  SupportBin operator()(const SupportBin& b) const {
    SupportBin r;
    const double t1 = tt * b.t + td * b.d, d1 = dt * b.t + dd * b.d;
    r.hits = b.hits;
    r.passed = b.passed;
    r.t = b.hits * t0 + t1;
    r.d = b.hits * d0 + d1;
    r.tt =
        b.hits * t0 * t0 + 2.0 * t0 * t1 + tt * tt * b.tt + 2.0 * tt * td * b.td + td * td * b.dd;
    r.dd =
        b.hits * d0 * d0 + 2.0 * d0 * d1 + dt * dt * b.tt + 2.0 * dt * dd * b.td + dd * dd * b.dd;
    r.td = b.hits * t0 * d0 + t0 * d1 + d0 * t1 + tt * dt * b.tt + (tt * dd + td * dt) * b.td +
           td * dd * b.dd;
    const double d_mean = b.hits > 0.0 ? b.d / b.hits : 0.0;
    r.t_min = t0 + tt * b.t_min + td * d_mean;
    r.t_max = t0 + tt * b.t_max + td * d_mean;
    if (r.t_min > r.t_max) std::swap(r.t_min, r.t_max);
    return r;
  }

  BinSums operator()(const BinSums& s) const {
    SupportBin b;
    b.hits = s.w;
    b.t = s.t;
    b.d = s.d;
    b.tt = s.tt;
    b.td = s.td;
    b.dd = s.dd;
    const SupportBin r = (*this)(b);
    return {r.hits, r.t, r.d, r.tt, r.td, r.dd};
  }
};

}  // namespace

Eigen::Vector2d Wall::fittedDirection() const {
  return (direction + fit.slope * normal()).normalized();
}

void absorb(Wall& wall, const Wall& other) {
  const FrameChange change(wall, other);
  for (int i = other.profile.first(); i < other.profile.last(); ++i) {
    const SupportBin& bin = other.profile.bin(i);
    if (bin.hits > 0.0) wall.profile.add(change(bin));
  }
}

BinSums sumsInFrameOf(const Wall& wall, const Wall& other) {
  return FrameChange(wall, other)(other.profile.sums());
}

void reanchor(Wall& wall, double tolerance) {
  if (wall.profile.empty()) return;
  const double t_first = wall.profile.first() * SupportProfile::kBinLength;
  const double t_last = wall.profile.last() * SupportProfile::kBinLength;
  if (std::abs(wall.fit.at(t_first)) < tolerance && std::abs(wall.fit.at(t_last)) < tolerance) {
    return;
  }
  Wall moved;
  moved.direction = wall.fittedDirection();
  const double t_mid = 0.5 * (t_first + t_last);
  moved.origin = wall.toMap(t_mid, wall.fit.at(t_mid));
  absorb(moved, wall);
  wall.origin = moved.origin;
  wall.direction = moved.direction;
  wall.profile = std::move(moved.profile);
  wall.fit = wall.profile.fit();
}

}  // namespace cca
