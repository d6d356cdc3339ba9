// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/region_outline.hpp"

#include <array>

#include "geometry/cross.hpp"

namespace cca {
namespace {

/// Steps along cell sides, counter-clockwise: right, up, left, down.
constexpr std::array<Cell, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
/// The cell on the left of a step from a corner, relative to it (corner (0, 0) is that of cell (0,
/// 0)).
constexpr std::array<Cell, 4> kLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
/// The cell on its right.
constexpr std::array<Cell, 4> kRight{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};

constexpr double kInset = 0.04;  // cells: apart by more than files round

/// Sides of cells that were passed already, by the cell on the left and the direction.
class PassedSides {
 public:
  explicit PassedSides(std::size_t cells) : passed_(cells, 0) {}
  bool pass(std::size_t cell, int direction) {
    const auto bit = static_cast<unsigned char>(1 << direction);
    if (passed_[cell] & bit) return false;
    passed_[cell] = static_cast<unsigned char>(passed_[cell] | bit);
    return true;
  }

 private:
  std::vector<unsigned char> passed_;
};

/// Whether cells of the set touch at a corner only.
template <class IsIn>
bool isPinch(Cell corner, IsIn&& is_in) {
  const bool right = is_in(corner + kLeft[0]), up = is_in(corner + kLeft[1]);
  const bool left = is_in(corner + kLeft[2]), down = is_in(corner + kLeft[3]);
  return right == left && up == down && right != up;
}

/// Follows the border from a corner until it closes.
Polygon follow(const Raster<int>& labels, Cell corner, int direction, PassedSides& passed) {
  const auto d0 = static_cast<std::size_t>(direction);
  const int label = labels[corner + kLeft[d0]];
  const auto isIn = [&](Cell c) { return labels.at(c, -1) == label; };
  Polygon chain;
  while (
      passed.pass(labels.index(corner + kLeft[static_cast<std::size_t>(direction)]), direction)) {
    chain.emplace_back(corner.x, corner.y);
    if (isPinch(corner, isIn)) {
      // The chain comes back to this corner, on the other cell's side.
      chain.back() +=
          kInset * (middleOf(corner + kLeft[static_cast<std::size_t>(direction)]) - chain.back());
    }
    corner = corner + kSteps[static_cast<std::size_t>(direction)];
    // Left first: cells that touch at a corner only do not hang together.
    for (const int turn : {1, 0, 3, 2}) {
      const auto next = static_cast<std::size_t>((direction + turn) % 4);
      if (!isIn(corner + kLeft[next]) || isIn(corner + kRight[next])) continue;
      direction = static_cast<int>(next);
      break;
    }
  }
  return chain;
}

}  // namespace

double signedArea(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    twice += cross(polygon[j], polygon[i]);
  return 0.5 * twice;
}

std::vector<RegionOutline> outlinesOfRegions(const Raster<int>& labels, int count) {
  std::vector<RegionOutline> found(static_cast<std::size_t>(count));
  PassedSides passed(labels.values.size());
  for (std::size_t k = 0; k < labels.values.size(); ++k) {
    const int label = labels.values[k];
    const Cell c = labels.cell(k);
    // The lower side of a cell, from left to right, has the cell on its left.
    if (label < 0 || labels.at(c + Cell{0, -1}, -1) == label) continue;
    Polygon chain = follow(labels, c, 0, passed);
    if (chain.empty()) continue;
    RegionOutline& outline = found[static_cast<std::size_t>(label)];
    (signedArea(chain) > 0.0 ? outline.outlines : outline.holes).push_back(std::move(chain));
  }
  return found;
}

}  // namespace cca
