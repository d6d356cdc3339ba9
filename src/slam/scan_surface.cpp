// SPDX-License-Identifier: BSD-3-Clause
#include "slam/scan_surface.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

Eigen::Vector2d towardsSensor(const Eigen::Vector2d& direction, const Eigen::Vector2d& p) {
  const Eigen::Vector2d normal{-direction.y(), direction.x()};
  return normal.dot(p) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

void takeNormalsOfLines(const std::vector<LineSegment>& lines, double straightness,
                        ScanSurface& surface) {
  const int count = static_cast<int>(surface.points.size());
  const double gate = std::max(straightness, kGates * surface.range_sigma);
  for (const LineSegment& line : lines) {
    const Eigen::Vector2d direction = line.direction();
    const double length = line.length();
    int beam = surface.beamTowards(line.start);
    const int last = surface.beamTowards(line.end);
    if (beam < 0 || last < 0) continue;
    for (int left = (last - beam + surface.beams()) % surface.beams(); left >= 0; --left) {
      const int i = surface.point_of_beam[static_cast<std::size_t>(beam)];
      beam = beam + 1 < surface.beams() ? beam + 1 : 0;
      if (i < 0 || i >= count) continue;
      ScanSurface::Point& point = surface.points[static_cast<std::size_t>(i)];
      const Eigen::Vector2d v = point.position - line.start;
      const double along = direction.dot(v);
      if (along < -gate || along > length + gate) continue;
      if (std::abs(cross(direction, v)) > gate) continue;
      point.normal = towardsSensor(direction, point.position);
    }
  }
}

/// Whether a direction from the centre, of any length, meets the arc.
bool spans(const Arc& arc, const Eigen::Vector2d& out) {
  const double from_start = wrapAngle(std::atan2(out.y(), out.x()) - arc.start_angle);
  return (from_start < 0.0 ? from_start + 2.0 * M_PI : from_start) <= arc.sweep;
}

/// A curved wall's lines are its chords. Their normals tell of a turn that is none.
void takeNormalsOfArcs(const std::vector<Arc>& arcs, ScanSurface& surface) {
  const double gate = kGates * surface.range_sigma;
  for (const Arc& arc : arcs) {
    for (ScanSurface::Point& point : surface.points) {
      const Eigen::Vector2d out = point.position - arc.centre;
      const double range = out.norm();
      if (std::abs(range - arc.radius) > gate || !spans(arc, out)) continue;
      point.normal = towardsSensor({-out.y() / range, out.x() / range}, point.position);
    }
  }
}

/// Five neighbouring returns are a surface where they are thin: a fifth as thick as long.
constexpr double kThin = 0.05;
constexpr int kNeighbours = 2;  // on either side: two of them would fit any line

void takeNormalsOfNeighbours(ScanSurface& surface) {
  const int count = static_cast<int>(surface.points.size());
  for (int i = kNeighbours; i + kNeighbours < count; ++i) {
    auto& point = surface.points[static_cast<std::size_t>(i)];
    if (!point.normal.isZero()) continue;
    const auto& first = surface.points[static_cast<std::size_t>(i - kNeighbours)];
    const auto& last = surface.points[static_cast<std::size_t>(i + kNeighbours)];
    if (last.beam - first.beam != 2 * kNeighbours) continue;
    PointMoments moments;
    double widest = 0.0;
    for (int k = i - kNeighbours; k <= i + kNeighbours; ++k) {
      const Eigen::Vector2d& p = surface.points[static_cast<std::size_t>(k)].position;
      moments.add(p);
      if (k > i - kNeighbours) {
        const Eigen::Vector2d& before = surface.points[static_cast<std::size_t>(k - 1)].position;
        widest = std::max(widest, (p - before).norm());
      }
    }
    const double range = point.position.norm();
    if (widest > std::max(0.15, 4.0 * range * surface.spacing)) continue;
    const FittedLine line = fitLine(moments);
    if (line.residual_sum_sq > kThin * line.spread_sum_sq) continue;
    point.normal = towardsSensor(line.direction, point.position);
  }
}

/// Between the nearest and the farthest of three neighbouring beams a surface may lie anywhere.
void takeFreeRangesOfThree(ScanSurface& surface) {
  const int beams = surface.beams();
  for (int k = 0; k < beams; ++k) {
    double least = surface.free_range[static_cast<std::size_t>(k)], most = least;
    for (int at : {k - 1, k + 1}) {
      if (surface.is_full_turn) at = at < 0 ? beams - 1 : at == beams ? 0 : at;
      if (at < 0 || at == beams) continue;
      least = std::min(least, surface.free_range[static_cast<std::size_t>(at)]);
      most = std::max(most, surface.free_range[static_cast<std::size_t>(at)]);
    }
    surface.least_free.push_back(static_cast<float>(least));
    surface.most_free.push_back(static_cast<float>(most));
  }
}

}  // namespace

void ScanSurface::pack() {
  packed.resize(points.size());
  padded.assign(point_of_beam.size() + 2 * kBeside, {});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& point = points[k];
    const PackedReturn single{
        static_cast<float>(point.position.x()), static_cast<float>(point.position.y()),
        static_cast<float>(point.normal.x()), static_cast<float>(point.normal.y())};
    packed.set(k, single);
    padded[static_cast<std::size_t>(point.beam + kBeside)] = single;
  }
  if (!is_full_turn || points.empty()) return;
  for (int k = 0; k < kBeside; ++k) {
    const int last = beams() - 1 - k % beams(), first = k % beams();
    padded[static_cast<std::size_t>(kBeside - 1 - k)] = returns()[last];
    padded[static_cast<std::size_t>(kBeside + beams() + k)] = returns()[first];
  }
}

ScanSurface scanSurface(const AnalysedScan& analysed) {
  const Scan& scan = analysed.scan;
  ScanSurface surface;
  const std::size_t beams = scan.size();
  if (beams < 3 || !std::isfinite(scan.angle_increment) || scan.angle_increment == 0.0 ||
      !std::isfinite(scan.angle_min)) {
    return surface;
  }
  const bool clockwise = scan.angle_increment < 0.0;
  surface.spacing = std::abs(scan.angle_increment);
  surface.first_bearing = wrapAngle(clockwise ? scan.bearing(beams - 1) : scan.angle_min);
  surface.range_sigma = analysed.noise.range_sigma;
  surface.is_full_turn = (static_cast<double>(beams) + 0.5) * surface.spacing > 2.0 * M_PI;
  surface.point_of_beam.assign(beams, -1);
  surface.free_range.assign(beams, 0.0);
  for (std::size_t k = 0; k < beams; ++k) {
    const std::size_t beam = clockwise ? beams - 1 - k : k;
    surface.free_range[k] = scan.freeRange(beam);
    const double range = scan.ranges[beam];
    if (!isReturn(range) || range > kFarthestSurface) continue;
    const double bearing = surface.first_bearing + static_cast<double>(k) * surface.spacing;
    surface.point_of_beam[k] = static_cast<int>(surface.points.size());
    surface.points.push_back({range * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)),
                              Eigen::Vector2d::Zero(), static_cast<int>(k)});
  }
  takeNormalsOfLines(analysed.lines, analysed.noise.straightness, surface);
  takeNormalsOfArcs(analysed.arcs, surface);
  takeNormalsOfNeighbours(surface);
  takeFreeRangesOfThree(surface);
  surface.pack();
  return surface;
}

ScanSurface scanSurface(const Scan& scan) { return scanSurface(analyse(scan)); }

}  // namespace cca
