// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/laser_evidence.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

using Slot = Walls::Slot;
constexpr double kLongestReturn = 100.0;  // m; no indoor wall is farther, and work stays bounded
constexpr double kLongestRay = 30.0;      // m; further out a beam is wider than a door
constexpr double kBlind = 0.05;           // m, before the sensor: nothing is seen there

/// The wall of the new line that each return lies on; -1 where there is none. The lines may come in
/// any order: those of a full turn begin at a corner, not at the first beam.
std::vector<Slot> wallsOfReturns(const Scan& scan, const std::vector<Eigen::Vector2d>& beams,
                                 const std::vector<NewLine>& lines, const MapNoise& noise) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  const double on_line = kGates * std::sqrt(noise.rangeVariance()) + 0.01;
  std::vector<Slot> slots(scan.size(), -1);
  std::vector<double> off(scan.size(), on_line);
  for (const NewLine& line : lines) {
    const Eigen::Vector2d u = line.segment.direction();
    const double length = line.segment.length();
    for (const BeamRange& range :
         beamsTowards(scan, line.segment.start, line.segment.end, on_line)) {
      for (std::size_t beam = range.first; beam < range.last; ++beam) {
        if (!isUsableReturn(scan.ranges[beam])) continue;
        const Eigen::Vector2d v = viewpoint + scan.ranges[beam] * beams[beam] - line.segment.start;
        const double t = u.dot(v), d = std::abs(cross(u, v));
        if (t < -1e-6 || t > length + 1e-6 || d >= off[beam]) continue;
        off[beam] = d;
        slots[beam] = line.wall;
      }
    }
  }
  return slots;
}

/// What the rays of a scan can say about places where they did not end.
struct Rays {
  Eigen::Vector2d origin;
  double clear;               ///< m, how far a ray has to go on behind a wall that it passed
  std::vector<double> reach;  ///< m, of each beam; 0 where it says nothing
};

Rays raysOf(const Scan& scan, const std::vector<Eigen::Vector2d>& beams, const MapNoise& noise) {
  Rays rays{scan.T_map_sensor.position(),
            std::max(SupportProfile::kResolved, kGates * noise.lateralSigma()),
            {}};
  rays.reach.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double reach = scan.ranges[beam];
    const bool tells = isReturn(reach) && reach > 2.0 * rays.clear && beams[beam].allFinite();
    rays.reach.push_back(tells ? std::min(reach, kLongestRay) : 0.0);
  }
  return rays;
}

/// The walls that the index names in the rectangle that the rays span, each once.
std::vector<Slot> wallsNear(const Rays& rays, const std::vector<Eigen::Vector2d>& beams,
                            Walls& walls) {
  std::vector<Slot> found;
  Eigen::AlignedBox2d swept(rays.origin);
  for (std::size_t beam = 0; beam < beams.size(); ++beam) {
    if (rays.reach[beam] > 0.0) swept.extend(rays.origin + rays.reach[beam] * beams[beam]);
  }
  const std::uint64_t visit = walls.nextVisit();
  const WallIndex::Cell low = WallIndex::cellOf(swept.min()), high = WallIndex::cellOf(swept.max());
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      for (const Slot slot : walls.at({x, y})) {
        if (std::exchange(walls[slot].visit, visit) != visit) found.push_back(slot);
      }
    }
  }
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
bool passThrough(const Scan& scan, const Rays& rays, const std::vector<Eigen::Vector2d>& beams,
                 Wall& wall, FirstPass* first) {
  const Eigen::Vector2d viewpoint = wall.toWall(rays.origin);
  // The line is off = distance * (facing . ray) away along a ray.
  const double side = wall.offLine(viewpoint) < 0.0 ? -1.0 : 1.0;
  const double off = side * wall.offLine(viewpoint);
  const Eigen::Vector2d facing = side * (wall.fit.slope * wall.direction - wall.normal());
  bool telling = false;
  const auto [start, end] = extentOf(wall);
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

bool isUsableReturn(double range) { return isReturn(range) && range <= kLongestReturn; }

std::vector<Eigen::Vector2d> beamDirections(const Scan& scan) {
  std::vector<Eigen::Vector2d> beams;
  beams.reserve(scan.size());
  TurningBeam direction(scan.T_map_sensor.theta + scan.angle_min, scan.angle_increment);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    direction.turnTo(beam);
    beams.emplace_back(direction.cosine(), direction.sine());
  }
  return beams;
}

std::array<BeamRange, 2> beamsTowards(const Scan& scan, const Eigen::Vector2d& start,
                                      const Eigen::Vector2d& end, double off) {
  const Pose2& T = scan.T_map_sensor;
  const Eigen::Vector2d a = start - T.position(), b = end - T.position();
  const double spacing = std::abs(scan.angle_increment), nearest = std::min(a.norm(), b.norm());
  const auto all = static_cast<double>(scan.size());
  if (!std::isfinite(scan.angle_min) || !std::isfinite(spacing)) return {};
  if (spacing <= 0.0 || !(nearest > off)) return {BeamRange{0, scan.size()}, {}};
  const double side = cross(a, b);
  const bool start_first = (side > 0.0) == (scan.angle_increment > 0.0);
  const Eigen::Vector2d& from = start_first ? a : b;
  const double turned = wrapAngle(std::atan2(from.y(), from.x()) - T.theta - scan.angle_min);
  const double first = scan.angle_increment > 0.0 ? turned : -turned;
  const double width = std::atan2(std::abs(side), a.dot(b));
  const double slack = spacing + std::asin(off / nearest);
  std::array<BeamRange, 2> ranges;
  for (std::size_t turn = 0; turn < 2; ++turn) {
    const double begin = first - slack + 2.0 * M_PI * static_cast<double>(turn);
    const double until = begin + width + 2.0 * slack;
    ranges[turn].first = static_cast<std::size_t>(std::clamp(begin / spacing, 0.0, all));
    ranges[turn].last = static_cast<std::size_t>(std::clamp(until / spacing + 1.0, 0.0, all));
  }
  return ranges;
}

void depositReturns(const Scan& scan, const std::vector<Eigen::Vector2d>& beams,
                    const std::vector<NewLine>& lines, const MapNoise& noise, Walls& walls,
                    std::vector<Eigen::Vector2d>* loose) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  const std::vector<Slot> walls_of_lines = wallsOfReturns(scan, beams, lines, noise);
  const double on_wall = kGates * noise.lateralSigma();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!isUsableReturn(scan.ranges[beam])) continue;
    const Eigen::Vector2d p = viewpoint + scan.ranges[beam] * beams[beam];
    Slot slot = walls_of_lines[beam];
    // A wall grows only where no other wall stands.
    if (slot < 0 || !walls[slot].hitNear(p)) {
      const Slot known = walls.hitBy(p, viewpoint, on_wall);
      if (known >= 0) slot = known;
    }
    if (slot >= 0) {
      walls.hit(slot, p);
    } else if (loose) {
      loose->push_back(p);
    }
  }
}

void passRays(const Scan& scan, const std::vector<Eigen::Vector2d>& beams, const MapNoise& noise,
              Walls& walls) {
  const Rays rays = raysOf(scan, beams, noise);
  std::vector<FirstPass> passes;
  for (const Slot slot : wallsNear(rays, beams, walls)) {
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
