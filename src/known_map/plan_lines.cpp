// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "geometry/cells_near.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kShortest = 1e-3;   // m: no wall is so short, and its direction would be rounding
constexpr double kFacesAlike = 0.9;  // cosine, 26 degrees: far from the wall around a corner
constexpr double kRounding = 1e-9;   // m: what is off a line by more than this is off its piece
/// m: what a ray crosses it crosses in a cell that it comes through, most of which are empty.
constexpr double kThroughCell = 0.4;
/// m: a piece is a quarter of a cell from one of its steps, at most.
constexpr double kThroughMargin = 0.3 * kThroughCell;

}  // namespace

PlanLines::PlanLines(const std::vector<PlanLine>& lines, const std::vector<LineSigma>& sigmas) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& [from, to] = lines[i];
    const LineSigma sigma = i < sigmas.size() ? sigmas[i] : LineSigma();
    const double length = (to - from).norm();
    if (!(length > kShortest)) continue;
    bounds_.extend(from);
    bounds_.extend(to);
    const int parts = static_cast<int>(std::ceil(length / kLongestPiece));
    for (int k = 0; k < parts; ++k) {
      const Eigen::Vector2d start = from + (to - from) * (static_cast<double>(k) / parts);
      pieces_.push_back(
          {start, (to - from) / length, length / parts, k == 0, k + 1 == parts, sigma});
    }
  }
  near_ = Grid(pieces_, kCell, kMostReach);
  through_ = Grid(pieces_, kThroughCell, kThroughMargin);
}

PlanLines::Grid::Grid(const std::vector<Piece>& pieces, double cell, double margin) : cell_(cell) {
  struct Stretch {
    int first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
    void extend(int from, int to) {
      first = std::min(first, from);
      last = std::max(last, to);
    }
  };
  const auto eachBlock = [&](const Piece& piece, const auto& visit) {
    const Eigen::Vector2d end = piece.start + piece.length * piece.direction;
    visitCellsNear(piece.start, end, margin, cell, visit);
  };
  if (pieces.empty()) return;
  Stretch all_rows;
  for (const Piece& piece : pieces)
    eachBlock(piece, [&](Cell low, Cell high) { all_rows.extend(low.y, high.y); });
  first_row_ = all_rows.first;
  std::vector<Stretch> columns(static_cast<std::size_t>(all_rows.last - first_row_) + 1);
  for (const Piece& piece : pieces) {
    eachBlock(piece, [&](Cell low, Cell high) {
      for (int y = low.y; y <= high.y; ++y)
        columns[static_cast<std::size_t>(y - first_row_)].extend(low.x, high.x);
    });
  }
  rows_.resize(columns.size());
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    if (columns[y].first > columns[y].last) continue;
    rows_[y].first = columns[y].first;
    rows_[y].cells.resize(static_cast<std::size_t>(columns[y].last - columns[y].first) + 1);
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto slot = static_cast<Slot>(k);
    eachBlock(pieces[k], [&](Cell low, Cell high) {
      for (int y = low.y; y <= high.y; ++y) {
        Row& row = rows_[static_cast<std::size_t>(y - first_row_)];
        for (int x = low.x; x <= high.x; ++x) {
          std::vector<Slot>& slots = row.cells[static_cast<std::size_t>(x - row.first)];
          if (slots.empty() || slots.back() != slot) slots.push_back(slot);
        }
      }
    });
  }
}

double PlanLines::distance(const Piece& piece, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d v = p_map - piece.start;
  const double along = std::clamp(piece.direction.dot(v), 0.0, piece.length);
  return (v - along * piece.direction).norm();
}

PlanLines::Slot PlanLines::nearest(const Eigen::Vector2d& p_map, const Eigen::Vector2d& normal,
                                   double reach) const {
  const double least_facing = normal.isZero() ? 0.0 : kFacesAlike;
  Slot best = -1;
  double nearest = reach;
  for (const Slot slot : near(p_map)) {
    const Piece& piece = (*this)[slot];
    if (std::abs(cross(piece.direction, normal)) < least_facing) continue;
    if (std::abs(cross(piece.direction, p_map - piece.start)) > nearest + kRounding) continue;
    const double apart = distance(piece, p_map);
    if (apart >= nearest) continue;
    nearest = apart;
    best = slot;
  }
  return best;
}

/// The first wanted piece, by the cells that a ray crosses.
template <class IsWanted>
PlanLines::Slot PlanLines::firstAlong(const Grid& grid, const Eigen::Vector2d& from,
                                      const Eigen::Vector2d& to, const IsWanted& is_wanted) {
  const Eigen::Vector2d way = (to - from) / grid.cell();
  const double length = way.norm();
  if (length <= 0.0) return -1;
  Slot found = -1;
  walkBeam(from / grid.cell(), way / length, length, [&](Cell cell, double) {
    for (const Slot slot : grid.at(cell)) {
      if (!is_wanted(slot)) continue;
      found = slot;
      return false;
    }
    return true;
  });
  return found;
}

PlanLines::Slot PlanLines::crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                   double behind, const std::vector<bool>& is_open) const {
  const auto isCrossed = [&](Slot slot) {
    const Piece& piece = (*this)[slot];
    const double off_from = cross(piece.direction, from - piece.start);
    const double off_to = cross(piece.direction, to - piece.start);
    if ((off_from > 0.0) == (off_to > 0.0)) return false;
    if (std::abs(off_to) < behind || std::abs(off_from) < kBlindCompared) return false;
    const Eigen::Vector2d at = from + (to - from) * (off_from / (off_from - off_to));
    const double along = piece.direction.dot(at - piece.start);
    return along >= (piece.begins ? kRimOfWall : 0.0) &&
           along <= piece.length - (piece.ends ? kRimOfWall : 0.0) &&
           (is_open.empty() || !is_open[static_cast<std::size_t>(slot)]);
  };
  if (firstAlong(through_, from, to, isCrossed) < 0) return -1;  // most rays
  return firstAlong(near_, from, to, isCrossed);
}

}  // namespace cca
