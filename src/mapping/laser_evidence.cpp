// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/laser_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cca_mrpt/geometry/cross.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

using Slot = Walls::Slot;
constexpr double kLongestReturn = 100.0;  // m

bool isUsable(double range) { return isReturn(range) && range <= kLongestReturn; }

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
        if (!isUsable(scan.ranges[beam])) continue;
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

}  // namespace

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
  const double all = static_cast<double>(scan.size());
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
                    const std::vector<NewLine>& lines, const MapNoise& noise, Walls& walls) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  const std::vector<Slot> walls_of_lines = wallsOfReturns(scan, beams, lines, noise);
  const double on_wall = kGates * noise.lateralSigma();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!isUsable(scan.ranges[beam])) continue;
    const Eigen::Vector2d p = viewpoint + scan.ranges[beam] * beams[beam];
    Slot slot = walls_of_lines[beam];
    // A wall grows only where no other wall stands.
    if (slot < 0 || !walls[slot].hitNear(p)) {
      const Slot known = walls.hitBy(p, viewpoint, on_wall);
      if (known >= 0) slot = known;
    }
    if (slot >= 0) walls.hit(slot, p);
  }
}

}  // namespace cca
