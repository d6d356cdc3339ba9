// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "cca_mrpt/mapping/laser_evidence.hpp"
#include "cca_mrpt/mapping/swept_cells.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

using Slot = Walls::Slot;
using Beams = std::vector<Eigen::Vector2d>;
constexpr double kLongestRay = 30.0;  // m; further out a beam is wider than a door
constexpr double kClear = 0.1;        // m, two bins: the least that counts as "behind"
constexpr double kBlind = 0.05;       // m, before the sensor
constexpr double kFarApart = 1.0;     // rad, beams between which nothing is taken for swept

constexpr std::size_t kFewWalls = 64;  // room for those of most scans

/// What the rays of a scan can say about places where they did not end.
struct Rays {
  Eigen::Vector2d origin;
  double clear;               ///< m, how far a ray has to go on behind a wall that it passed
  std::vector<double> reach;  ///< m, of each beam; 0 where it says nothing
};

Rays raysOf(const Scan& scan, const Beams& beams, const MapNoise& noise) {
  Rays rays{scan.T_map_sensor.position(), std::max(kClear, kGates * noise.lateralSigma()), {}};
  rays.reach.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double reach = scan.freeRange(beam);
    const bool tells = reach > 2.0 * rays.clear && beams[beam].allFinite();
    rays.reach.push_back(tells ? std::min(reach, kLongestRay) : 0.0);
  }
  return rays;
}

/// The walls that the index names where the rays went, each once.
std::vector<Slot> wallsNear(const Scan& scan, const Rays& rays, const Beams& beams, Walls& walls) {
  std::vector<Slot> found;
  if (scan.size() == 0) return found;
  found.reserve(kFewWalls);
  SweptCells cells(rays.origin, *std::max_element(rays.reach.begin(), rays.reach.end()));
  const bool far_apart = std::abs(scan.angle_increment) > kFarApart;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double last = rays.reach[beam] - 2.0 * rays.clear;
    if (far_apart || last <= 0.0) cells.breakOff();
    if (last > 0.0) cells.sweepTo(rays.origin + last * beams[beam]);
  }
  cells.breakOff();
  const std::uint64_t visit = walls.nextVisit();
  cells.forEach([&](const WallIndex::Cell& cell) {
    for (const Slot slot : walls.at(cell)) {
      if (std::exchange(walls[slot].visit, visit) != visit) found.push_back(slot);
    }
  });
  return found;
}

/// The first ray of a scan that told something new of a wall that it went through.
struct FirstPass {
  std::size_t beam;
  double distance;  ///< m, along the ray
  Slot slot;
  bool operator<(const FirstPass& o) const {
    return std::tie(beam, distance, slot) < std::tie(o.beam, o.distance, o.slot);
  }
};

/// Counts the rays that went clearly through the wall's line; false where they tell nothing new.
bool passThrough(const Scan& scan, const Rays& rays, const Beams& beams, Wall& wall,
                 FirstPass* first) {
  const Eigen::Vector2d viewpoint = wall.toWall(rays.origin);
  // The line is off = distance * (facing . ray) away along a ray.
  double off = wall.offLine(viewpoint);
  Eigen::Vector2d facing = wall.fit.slope * wall.direction - wall.normal();
  if (off < 0.0) {
    off = -off;
    facing = -facing;
  }
  bool telling = false;
  const double start = wall.profile.first() * SupportProfile::kBinLength;
  const double end = wall.profile.last() * SupportProfile::kBinLength;
  for (const BeamRange& range : beamsTowards(scan, wall.onLine(start), wall.onLine(end), 0.0)) {
    for (std::size_t beam = range.first; beam < range.last; ++beam) {
      const double closing = facing.dot(beams[beam]), reach = rays.reach[beam];
      // The line has to be well before the ray's end, both across and along.
      if (reach * closing - off < rays.clear) continue;
      const double at = off / closing;
      if (at <= kBlind || at >= reach - 2.0 * rays.clear) continue;
      const double t = viewpoint.x() + at * wall.direction.dot(beams[beam]);
      if (!wall.profile.contains(SupportProfile::binOf(t))) continue;
      if (!wall.profile.pass(t)) continue;
      if (!telling) *first = {beam, at, -1};
      telling = true;
    }
  }
  return telling;
}

}  // namespace

void passRays(const Scan& scan, const Beams& beams, const MapNoise& noise, Walls& walls) {
  const Rays rays = raysOf(scan, beams, noise);
  std::vector<FirstPass> passes;
  passes.reserve(kFewWalls);
  for (const Slot slot : wallsNear(scan, rays, beams, walls)) {
    FirstPass first;
    if (!passThrough(scan, rays, beams, walls[slot], &first)) continue;
    first.slot = slot;
    passes.push_back(first);
  }
  // Walls are seen to in the order in which the scan meets them.
  std::sort(passes.begin(), passes.end());
  for (const FirstPass& pass : passes) walls.touch(pass.slot);
}

}  // namespace cca
