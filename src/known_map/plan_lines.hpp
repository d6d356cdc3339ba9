// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "cca_mrpt/known_map/plan.hpp"
#include "mapping/wall_index.hpp"

namespace cca {

/// The lines of a finished map or of a drawn plan, cut into pieces, with the index that finds them.
///
/// A plan does not tell which side of a line is the wall: each piece is seen from both.
class PlanLines {
 public:
  using Slot = WallIndex::Slot;

  struct Piece {
    Eigen::Vector2d start;      ///< m
    Eigen::Vector2d direction;  ///< unit
    double length;              ///< m, at most kLongestPiece
    bool begins, ends;          ///< whether the line does not go on before, or behind it
    LineSigma sigma;            ///< of its line

    Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
  };

  /// m. A wall of a building is true to its line over a few metres, and then it bends or is off:
  /// the error of a plan is one number a piece.
  static constexpr double kLongestPiece = 2.0;
  static constexpr double kMostReach = 0.6;  ///< m, from a piece, that it can be asked for

  PlanLines() = default;
  /// @param lines   finite; those shorter than a millimetre are left out.
  /// @param sigmas  one a line; empty: nobody tells, and the plan is taken at its word.
  explicit PlanLines(const std::vector<PlanLine>& lines, const std::vector<LineSigma>& sigmas = {});

  bool empty() const { return pieces_.empty(); }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const Piece& operator[](Slot slot) const { return pieces_[static_cast<std::size_t>(slot)]; }
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }  ///< m

  /// The pieces within kMostReach of a point, and others. Cost: that of one hash.
  const std::vector<Slot>& near(const Eigen::Vector2d& p_map) const {
    return index_.at(WallIndex::cellOf(p_map));
  }
  /// The piece whose line lies next to a point.
  /// @param normal  unit, of the surface at the point: its piece faces alike, or the other way;
  ///                zero: whatever it faces.
  /// @param reach   m, up to kMostReach.
  /// @return  -1 where there is none. Cost: pieces near.
  Slot nearest(const Eigen::Vector2d& p_map, const Eigen::Vector2d& normal, double reach) const;
  /// m, from a point to a piece.
  static double distance(const Piece& piece, const Eigen::Vector2d& p_map);

  /// Whether a ray has gone through a line: it ends `behind` [m] behind it at least, begins before
  /// it, and does not pass by the line's end. Cost: cells that the ray crosses.
  /// @param is_open  by slot: pieces that rays may pass; empty: none may.
  /// @return  the first such piece found, or -1.
  Slot crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double behind,
               const std::vector<bool>& is_open) const;

 private:
  std::vector<Piece> pieces_;
  WallIndex index_;
  Eigen::AlignedBox2d bounds_;
};

}  // namespace cca
