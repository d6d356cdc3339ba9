// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_lines.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/geometry/cell.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kShortest = 1e-3;   // m: no wall is so short, and its direction would be rounding
constexpr double kFacesAlike = 0.9;  // cosine, 26 degrees: far from the wall around a corner

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
  std::vector<WallIndex::Cell> cells;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    cells.clear();
    index_.insert(static_cast<Slot>(i), piece.start, piece.start + piece.length * piece.direction,
                  kMostReach, cells);
  }
}

double PlanLines::distance(const Piece& piece, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d v = p_map - piece.start;
  const double along = std::clamp(piece.direction.dot(v), 0.0, piece.length);
  return (v - along * piece.direction).norm();
}

PlanLines::Slot PlanLines::nearest(const Eigen::Vector2d& p_map, const Eigen::Vector2d& normal,
                                   double reach) const {
  Slot best = -1;
  double nearest = reach;
  for (const Slot slot : near(p_map)) {
    const Piece& piece = (*this)[slot];
    if (!normal.isZero() && std::abs(cross(piece.direction, normal)) < kFacesAlike) continue;
    const double apart = distance(piece, p_map);
    if (apart >= nearest) continue;
    nearest = apart;
    best = slot;
  }
  return best;
}

PlanLines::Slot PlanLines::crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                   double behind, const std::vector<bool>& is_open) const {
  const auto isCrossed = [&](Slot slot) {
    const Piece& piece = (*this)[slot];
    if (!is_open.empty() && is_open[static_cast<std::size_t>(slot)]) return false;
    const double off_from = cross(piece.direction, from - piece.start);
    const double off_to = cross(piece.direction, to - piece.start);
    if ((off_from > 0.0) == (off_to > 0.0)) return false;
    if (std::abs(off_to) < behind || std::abs(off_from) < kBlindCompared) return false;
    const Eigen::Vector2d at = from + (to - from) * (off_from / (off_from - off_to));
    const double along = piece.direction.dot(at - piece.start);
    return along >= (piece.begins ? kRimOfWall : 0.0) &&
           along <= piece.length - (piece.ends ? kRimOfWall : 0.0);
  };
  const Eigen::Vector2d way = (to - from) / WallIndex::kCellSize;
  const double length = way.norm();
  if (length <= 0.0) return -1;
  Slot found = -1;
  walkBeam(from / WallIndex::kCellSize, way / length, length, [&](Cell cell, double) {
    const auto& slots = index_.at({cell.x, cell.y});
    const auto first = std::find_if(slots.begin(), slots.end(), isCrossed);
    if (first != slots.end()) found = *first;
    return found < 0;
  });
  return found;
}

}  // namespace cca
