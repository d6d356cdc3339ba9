// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/laser_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cca {
namespace {

using Slot = Walls::Slot;
constexpr double kGates = 3.0;
constexpr double kLongestRay = 30.0;  // m; further out a beam is wider than a door
constexpr double kLongestReturn = 100.0;
constexpr double kClear = 0.1;   // m, two bins: the least that counts as "behind"
constexpr double kBlind = 0.05;  // m, before the sensor

/// Walks the cells of the index along a ray [Amanatides & Woo 1987].
class CellWalk {
 public:
  CellWalk(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction)
      : cell_(WallIndex::cellOf(origin)) {
    for (int k = 0; k < 2; ++k) {
      step_[k] = direction[k] < 0.0 ? -1 : 1;
      const double edge = (cell_[k] + (step_[k] > 0 ? 1 : 0)) * WallIndex::kCellSize;
      const bool moves = direction[k] != 0.0;
      next_[k] =
          moves ? (edge - origin[k]) / direction[k] : std::numeric_limits<double>::infinity();
      stride_[k] = moves ? WallIndex::kCellSize / std::abs(direction[k]) : 0.0;
    }
  }
  const WallIndex::Cell& cell() const { return cell_; }
  double entered() const { return entered_; }
  void advance() {
    const int k = next_[0] < next_[1] ? 0 : 1;
    entered_ = next_[k];
    next_[k] += stride_[k];
    cell_[k] += step_[k];
  }

 private:
  WallIndex::Cell cell_;
  int step_[2] = {0, 0};
  double next_[2] = {0.0, 0.0}, stride_[2] = {0.0, 0.0}, entered_ = 0.0;
};

struct Ray {
  Eigen::Vector2d origin, direction;
  double reach, clear;
};

bool isUsable(double range) { return isReturn(range) && range <= kLongestReturn; }

/// Half-open range of beams.
struct BeamRange {
  std::size_t first = 0, last = 0;
};

/// The beams that can meet a line, within `off` [m] of it: one range, or two where the line lies
/// across the scan's seam or the last beams repeat the first.
std::array<BeamRange, 2> beamsTowards(const Scan& scan, const LineSegment& line, double off) {
  const Pose2& T = scan.T_map_sensor;
  const Eigen::Vector2d a = line.start - T.position(), b = line.end - T.position();
  const double spacing = std::abs(scan.angle_increment), nearest = std::min(a.norm(), b.norm());
  const double all = static_cast<double>(scan.size());
  if (!(spacing > 0.0) || !(nearest > off)) return {BeamRange{0, scan.size()}, {}};
  const Eigen::Vector2d& from = scan.angle_increment > 0.0 ? a : b;  // met first
  const double turned = wrapAngle(std::atan2(from.y(), from.x()) - T.theta - scan.angle_min);
  const double first = scan.angle_increment > 0.0 ? turned : -turned;
  const double width = std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  const double slack = spacing + std::asin(off / nearest);
  std::array<BeamRange, 2> ranges;
  for (std::size_t turn = 0; turn < 2; ++turn) {
    const double begin = first - slack + 2.0 * M_PI * static_cast<double>(turn);
    const double end = begin + width + 2.0 * slack;
    ranges[turn].first = static_cast<std::size_t>(std::clamp(begin / spacing, 0.0, all));
    ranges[turn].last = static_cast<std::size_t>(std::clamp(end / spacing + 1.0, 0.0, all));
  }
  return ranges;
}

/// The wall of the new line that each return lies on; -1 where there is none. The lines may come in
/// any order: those of a full turn begin at a corner, not at the first beam.
std::vector<Slot> wallsOfReturns(const Scan& scan, const std::vector<Eigen::Vector2d>& beams,
                                 const std::vector<NewLine>& lines, std::size_t scan_in_batch,
                                 const MapNoise& noise) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  const double on_line = kGates * std::sqrt(noise.rangeVariance()) + 0.01;
  std::vector<Slot> slots(scan.size(), -1);
  std::vector<double> off(scan.size(), on_line);
  for (const NewLine& line : lines) {
    if (line.scan != scan_in_batch) continue;
    const Eigen::Vector2d u = line.segment.direction();
    const double length = line.segment.length();
    for (const BeamRange& range : beamsTowards(scan, line.segment, on_line)) {
      for (std::size_t beam = range.first; beam < range.last; ++beam) {
        if (!isUsable(scan.ranges[beam])) continue;
        const Eigen::Vector2d v = viewpoint + scan.ranges[beam] * beams[beam] - line.segment.start;
        const double t = u.dot(v), d = std::abs(u.x() * v.y() - u.y() * v.x());
        if (t < -1e-6 || t > length + 1e-6 || d >= off[beam]) continue;
        off[beam] = d;
        slots[beam] = line.wall;
      }
    }
  }
  return slots;
}

/// All rays of a scan come from one place: where that is from the wall is found once.
void see(Wall& wall, const Eigen::Vector2d& viewpoint) {
  const Eigen::Vector2d td = wall.toWall(viewpoint);
  wall.viewpoint_t = td.x();
  wall.viewpoint_off = wall.offLine(td);
}

/// Where along the wall the ray went clearly through its line; false where it did not.
bool passes(const Ray& ray, const Wall& wall, double* t_cross) {
  const double along = wall.direction.dot(ray.direction);
  const double across =
      wall.direction.x() * ray.direction.y() - wall.direction.y() * ray.direction.x();
  const double closing = wall.fit.slope * along - across, off = wall.viewpoint_off;
  // off / closing is the distance along the ray; it has to be positive and well before its end.
  if (off * closing <= 0.0) return false;
  if (ray.reach * std::abs(closing) - std::abs(off) < ray.clear) return false;
  const double at = off / closing;
  if (at <= kBlind || at >= ray.reach - 2.0 * ray.clear) return false;
  *t_cross = wall.viewpoint_t + at * along;
  return wall.profile.contains(SupportProfile::binOf(*t_cross));
}

}  // namespace

std::vector<Eigen::Vector2d> beamDirections(const Scan& scan) {
  std::vector<Eigen::Vector2d> beams(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double bearing = scan.T_map_sensor.theta + scan.bearing(beam);
    beams[beam] = {std::cos(bearing), std::sin(bearing)};
  }
  return beams;
}

void depositReturns(const Scan& scan, const std::vector<Eigen::Vector2d>& beams,
                    const std::vector<NewLine>& lines, std::size_t scan_in_batch,
                    const MapNoise& noise, Walls& walls) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  const std::vector<Slot> walls_of_lines = wallsOfReturns(scan, beams, lines, scan_in_batch, noise);
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
    if (slot < 0) continue;
    Wall& wall = walls[slot];
    const Eigen::Vector2d td = wall.toWall(p);
    wall.profile.hit(td.x(), td.y());
    wall.hits += 1.0;
    walls.touch(slot);
  }
}

void passRays(const Scan& scan, const std::vector<Eigen::Vector2d>& beams, const MapNoise& noise,
              Walls& walls) {
  Ray ray;
  ray.origin = scan.T_map_sensor.position();
  ray.clear = std::max(kClear, kGates * noise.lateralSigma());
  const std::uint64_t first_ray = walls.nextRay();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = scan.ranges[beam];
    ray.reach = isReturn(range) ? range : isNoReturn(range) ? scan.free_range_without_return : 0.0;
    ray.reach = std::min(ray.reach, kLongestRay);
    if (!(ray.reach > 2.0 * ray.clear)) continue;
    ray.direction = beams[beam];
    const std::uint64_t number = walls.nextRay();
    const double last = ray.reach - 2.0 * ray.clear;
    for (CellWalk walk(ray.origin, ray.direction); walk.entered() < last; walk.advance()) {
      for (const Slot slot : walls.at(walk.cell())) {
        Wall& wall = walls[slot];
        double t = 0.0;
        if (wall.ray == number) continue;
        if (wall.ray < first_ray) see(wall, ray.origin);
        wall.ray = number;
        if (!passes(ray, wall, &t)) continue;
        wall.profile.pass(t);
        walls.touch(slot);
      }
    }
  }
}

}  // namespace cca
