// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/furniture.hpp"

#include <algorithm>
#include <cmath>

#include "floor_plan/components.hpp"
#include "floor_plan/region_outline.hpp"
#include "floor_plan/room_outline.hpp"
#include "geometry/cross.hpp"
#include "geometry/distance_to_segment.hpp"

namespace cca {
namespace {

constexpr double kSquareSide = 0.26;  // cosine of 75 degrees: nothing stands more aslant on a wall

bool isOnOpening(const Eigen::Vector2d& p, const std::vector<Passage>& openings,
                 const FurnitureTuning& tuning) {
  return std::any_of(openings.begin(), openings.end(), [&](const Passage& opening) {
    return distanceToSegment(opening.a, opening.b, p) < tuning.in_line;
  });
}

/// Whether corners k .. k + 5 go along a wall, around something that leans on it, and on.
bool isStep(const Polygon& outline, std::size_t k, const std::vector<Passage>& openings,
            const FurnitureTuning& tuning) {
  const auto at = [&](std::size_t i) -> const Eigen::Vector2d& {
    return outline[(k + i) % outline.size()];
  };
  Eigen::Vector2d way[5];
  double length[5];
  for (std::size_t i = 0; i < 5; ++i) {
    way[i] = at(i + 1) - at(i);
    length[i] = way[i].norm();
    if (length[i] <= 0.0) return false;
    way[i] /= length[i];
  }
  if (std::min(length[0], length[4]) < tuning.wall_beside) return false;
  if (length[2] > tuning.most_width) return false;
  for (const std::size_t side : {1, 3}) {
    if (length[side] < tuning.least_depth || length[side] > tuning.most_depth) return false;
    if (std::abs(way[side].dot(way[0])) > kSquareSide) return false;
  }
  // Into the room, along the wall, and back.
  if (cross(way[0], way[1]) < 0.0 || cross(way[0], way[3]) > 0.0) return false;
  if (way[2].dot(way[0]) < kCosOneWall || way[4].dot(way[0]) < kCosOneWall) return false;
  if (std::abs(cross(way[0], Eigen::Vector2d(at(4) - at(1)))) >= tuning.in_line) return false;
  const Eigen::Vector2d before = at(1) - 0.5 * tuning.wall_beside * way[0];
  const Eigen::Vector2d after = at(4) + 0.5 * tuning.wall_beside * way[4];
  return !isOnOpening(before, openings, tuning) && !isOnOpening(after, openings, tuning);
}

/// Whether no room was found inside.
bool isEmpty(const Raster<int>& room_of, const Polygon& outline) {
  const Eigen::AlignedBox2d box = boundsOf(outline);
  const Cell low = room_of.cellOf(box.min()), high = room_of.cellOf(box.max());
  int inside = 0, in_rooms = 0;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!isInside(outline, room_of.centreOf({x, y}))) continue;
      ++inside;
      in_rooms += room_of.at({x, y}, 0) != 0;
    }
  }
  return 4 * in_rooms <= inside;
}

}  // namespace

std::vector<PlanFurniture> freeStanding(const Mask& furniture, const FurnitureTuning& tuning) {
  const Components parts = connectedComponents(furniture, 4);
  const auto outlines = outlinesOfRegions(parts.labels, static_cast<int>(parts.sizes.size()));
  const double cell = furniture.resolution * furniture.resolution;
  std::vector<PlanFurniture> found;
  for (std::size_t k = 0; k < parts.sizes.size(); ++k) {
    if (static_cast<double>(parts.sizes[k]) * cell < tuning.smallest - 1e-9) continue;
    PlanFurniture piece;
    piece.outline =
        straightened(parts.labels, outlines[k].outlines.front(), OutlineTuning{}.tolerance);
    if (piece.outline.size() >= 3) found.push_back(piece);
  }
  return found;
}

std::vector<PlanFurniture> cutLeaning(Polygon& outline, const Raster<int>& room_of,
                                      const std::vector<Passage>& openings,
                                      const FurnitureTuning& tuning) {
  std::vector<PlanFurniture> found;
  for (std::size_t k = 0; outline.size() >= 8 && k < outline.size();) {
    const std::size_t n = outline.size();
    PlanFurniture piece;
    piece.leans = true;
    for (std::size_t i = 4; i >= 1; --i) piece.outline.push_back(outline[(k + i) % n]);
    if (!isStep(outline, k, openings, tuning) || !isEmpty(room_of, piece.outline)) {
      ++k;
      continue;
    }
    found.push_back(piece);
    Polygon left;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t step = (i + n - k) % n;
      if (step < 1 || step > 4) left.push_back(outline[i]);
    }
    outline.swap(left);
    k = 0;
  }
  return found;
}

}  // namespace cca
