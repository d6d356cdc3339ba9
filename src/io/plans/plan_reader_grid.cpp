// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "floor_plan/region_outline.hpp"
#include "geometry/cross.hpp"
#include "plan_reader_formats.hpp"

namespace cca {
namespace {

constexpr int kFreeLabel = 0, kOccupiedLabel = 1, kUnknownLabel = 2;
/// Cells: the corners of a slanted wall's cells lie within this of a line.
constexpr double kStairs = 0.9;
constexpr double kShortestFace = 0.12;  // m: less is a speck

using Chain = std::vector<Eigen::Vector2d>;

/// The farthest corner between two of a chain from the line through these; `last` where none is
/// farther than kStairs [Douglas & Peucker 1973].
std::size_t corner(const Chain& chain, std::size_t first, std::size_t last) {
  const Eigen::Vector2d along = (chain[last] - chain[first]).normalized();
  double farthest = kStairs;
  std::size_t found = last;
  for (std::size_t k = first + 1; k < last; ++k) {
    const Eigen::Vector2d v = chain[k] - chain[first];
    const double off = along.isZero() ? v.norm() : std::abs(cross(along, v));
    if (off <= farthest) continue;
    farthest = off;
    found = k;
  }
  return found;
}

/// The line that the sides of cells from one corner to another stand for: stairs lie to both its
/// sides. In cells.
PlanLine faceOf(const Chain& chain, std::size_t first, std::size_t last) {
  PointMoments moments;
  for (std::size_t k = first; k < last; ++k) {
    moments.add(0.5 * (chain[k] + chain[k + 1]), (chain[k + 1] - chain[k]).norm());
  }
  const FittedLine line = fitLine(moments);
  const auto onLine = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(line.centroid + line.direction * line.direction.dot(p - line.centroid));
  };
  return {onLine(chain[first]), onLine(chain[last])};
}

void addFaces(const Chain& chain, std::size_t first, std::size_t last,
              const OccupancyRaster& raster, std::vector<PlanLine>& lines) {
  if (last <= first) return;
  const std::size_t split = corner(chain, first, last);
  if (split != last) {
    addFaces(chain, first, split, raster, lines);
    addFaces(chain, split, last, raster, lines);
    return;
  }
  const PlanLine face = faceOf(chain, first, last);
  if ((face.second - face.first).norm() * raster.resolution < kShortestFace) return;
  lines.emplace_back(raster.inMetres(face.first), raster.inMetres(face.second));
}

/// The stretches of a border of free cells that have occupied ones behind them.
void addBorder(Polygon border, const Raster<int>& labels, const OccupancyRaster& raster,
               std::vector<PlanLine>& lines) {
  border.push_back(border.front());
  Chain chain;
  const auto finish = [&] {
    if (chain.size() > 1) addFaces(chain, 0, chain.size() - 1, raster, lines);
    chain.clear();
  };
  for (std::size_t k = 1; k < border.size(); ++k) {
    const Eigen::Vector2d step = border[k] - border[k - 1];
    const Eigen::Vector2d right = Eigen::Vector2d(step.y(), -step.x()).normalized();
    const Cell behind = cellAt(0.5 * (border[k] + border[k - 1]) + 0.5 * right);
    if (labels.at(behind, kUnknownLabel) != kOccupiedLabel) {
      finish();
      continue;
    }
    if (chain.empty()) chain.push_back(border[k - 1]);
    chain.push_back(border[k]);
  }
  finish();
}

}  // namespace

PlanFile gridPlan(const OccupancyRaster& raster) {
  Raster<int> labels = raster.alike(kUnknownLabel);
  for (std::size_t k = 0; k < raster.values.size(); ++k) {
    if (raster.values[k] == Occupancy::kFree) labels.values[k] = kFreeLabel;
    if (raster.values[k] == Occupancy::kOccupied) labels.values[k] = kOccupiedLabel;
  }
  PlanFile plan;
  plan.kind = "map_server grid";
  const RegionOutline free = outlinesOfRegions(labels, 3)[kFreeLabel];
  for (const Polygon& border : free.outlines) addBorder(border, labels, raster, plan.lines);
  for (const Polygon& border : free.holes) addBorder(border, labels, raster, plan.lines);
  return plan;
}

}  // namespace cca
