// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cca_mrpt/geometry/cell.hpp"
#include "cca_mrpt/known_map/plan.hpp"

namespace cca {

/// The lines of a finished map or of a drawn plan, cut into pieces, with the grids that find them.
///
/// A plan does not tell which side of a line is the wall: each piece is seen from both.
class PlanLines {
 public:
  using Slot = std::int32_t;

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
  /// m; some more than kMostReach: smaller cells name a piece oftener, larger ones name pieces that
  /// nobody asks for.
  static constexpr double kCell = 0.8;

  PlanLines() = default;
  /// @param lines   finite; those shorter than a millimetre are left out.
  /// @param sigmas  one a line; empty: nobody tells, and the plan is taken at its word.
  explicit PlanLines(const std::vector<PlanLine>& lines, const std::vector<LineSigma>& sigmas = {});

  bool empty() const { return pieces_.empty(); }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const Piece& operator[](Slot slot) const { return pieces_[static_cast<std::size_t>(slot)]; }
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }  ///< m

  /// The pieces within kMostReach of a point, and others. Cost: O(1).
  const std::vector<Slot>& near(const Eigen::Vector2d& p_map) const {
    return near_.at(cellAt(p_map / kCell));
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
  /// @return  the first such piece, by the cells that it is near; -1: none.
  Slot crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double behind,
               const std::vector<bool>& is_open) const;

 private:
  /// The pieces that come within a margin of each cell, in their order. Each row is as long as its
  /// pieces need: a stray line of a drawing, a kilometre off, costs little.
  class Grid {
   public:
    Grid() = default;
    Grid(const std::vector<Piece>& pieces, double cell, double margin);
    double cell() const { return cell_; }  ///< m
    const std::vector<Slot>& at(Cell c) const {
      const auto y = static_cast<std::size_t>(std::int64_t{c.y} - first_row_);
      if (y >= rows_.size()) return none_;
      const Row& row = rows_[y];
      const auto x = static_cast<std::size_t>(std::int64_t{c.x} - row.first);
      return x < row.cells.size() ? row.cells[x] : none_;
    }

   private:
    struct Row {
      int first = 0;
      std::vector<std::vector<Slot>> cells;
    };
    double cell_ = 1.0;
    int first_row_ = 0;
    std::vector<Row> rows_;
    inline static const std::vector<Slot> none_;
  };
  template <class IsWanted>
  static Slot firstAlong(const Grid& grid, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                         const IsWanted& is_wanted);

  std::vector<Piece> pieces_;
  Grid near_;     ///< within kMostReach
  Grid through_;  ///< in the cell itself
  Eigen::AlignedBox2d bounds_;
};

}  // namespace cca
