// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "cca_mrpt/navigation/place/cell.hpp"
#include "cca_mrpt/navigation/place/exploration_grid.hpp"

namespace cca {

/// Where the robot's centre may be, as far as is known: free cells that keep a clearance from every
/// occupied cell, and cells where it has been. The robot's configuration space, since the robot is
/// round.
///
/// A cell that was open stays so as long as the clearance is kept at any point of it, not only at
/// its centre: noise of a cell must not open and shut a passage scan by scan.
///
/// Unknown cells are not grown: what they hold is for the local planner to see in time.
class FreeSpace {
 public:
  /// Blocks of kBlock x kBlock cells are the coarse squares that long paths are searched on.
  static constexpr int kBlockBits = 2, kBlock = 1 << kBlockBits;
  static Cell blockOf(Cell c) { return {c.x >> kBlockBits, c.y >> kBlockBits}; }
  static unsigned bitOf(Cell c) {
    return 1u << (((c.y & (kBlock - 1)) << kBlockBits) | (c.x & (kBlock - 1)));
  }

  /// Visits those cells of a block whose bits are set: void(Cell), row by row from the lowest.
  template <class Visit>
  static void eachCell(Cell block, unsigned bits, Visit&& visit) {
    for (int k = 0; bits >> k; ++k) {
      if (bits >> k & 1) visit(Cell{kBlock * block.x + k % kBlock, kBlock * block.y + k / kBlock});
    }
  }

  /// @param clearance   m, from a cell's centre to the nearest point of an occupied cell.
  /// @param resolution  m, the grid's.
  FreeSpace(double clearance, double resolution);

  /// Takes over the cells that have changed. Cost: cells that became occupied or ceased to be,
  /// times the cells of the grown disc.
  void update(const ExplorationGrid& grid, const std::vector<Cell>& changed);

  /// The robot's centre has been in this cell, so it can be there again, whatever noise says of the
  /// clearance, as long as the cell itself is not seen occupied: what the robot came through must
  /// not close behind it.
  void pass(Cell c);

  /// Shuts a cell that looks free, or opens it again: the robot could not drive there. A cell that
  /// it has been in stays open.
  void bar(Cell c, bool is_barred);

  /// From now on a cell opens where the clearance is kept at any point of it. All that is known
  /// lies in the cells from `low` to `high`. Cost: O(these cells).
  void openNarrowPassages(Cell low, Cell high);
  bool hasNarrowPassages() const { return has_narrow_passages_; }

  bool isTraversable(Cell c) const { return cells_.at(c).isTraversable(); }
  /// Like isTraversable, for each cell of a block: bit 4 (y mod 4) + (x mod 4).
  unsigned traversableCells(Cell block) const { return blocks_.at(block); }

  double clearance() const { return clearance_; }

 private:
  struct Place {
    std::uint16_t near = 0;   ///< obstacles that come nearer to its centre than the clearance
    std::uint16_t close = 0;  ///< those of them that do to all of its points
    CellState state = CellState::kUnknown;
    bool is_open = false, is_passed = false, is_barred = false;

    bool isTraversable() const {
      return (is_open && !is_barred) || (is_passed && state != CellState::kOccupied);
    }
  };
  struct Grown {
    Cell offset;
    bool is_close;
  };

  void grow(Cell obstacle, int count);
  void settle(Cell c, Place& place);

  double clearance_;
  bool has_narrow_passages_ = false;
  std::vector<Grown> disc_;  ///< the cells that an obstacle comes near to
  TiledGrid<Place> cells_;
  TiledGrid<std::uint16_t> blocks_;  ///< traversable cells, a bit each
};

}  // namespace cca
