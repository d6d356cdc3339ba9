// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"

namespace cca {

/// Where the robot's centre may be, as far as is known: free cells that keep a clearance from every
/// occupied cell, and cells where it has been. The robot's configuration space, since the robot is
/// round.
///
/// A cell that was open stays so while at most three obstacles come nearer, none by more than a
/// cell: as much does one noisy cell take of a passage, and noise must not open and shut it scan by
/// scan. Of a wall it would be more. Where the robot has been it may be eight that come nearer by a
/// cell, for walls are drawn where the poses of scans say: more stand where its hull was, and have
/// come since then.
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
  /// clearance: what the robot came through must not close behind it. Not so while the cell itself
  /// is seen occupied, or something stands where the hull would be, somebody who has come since.
  void pass(Cell c);

  bool isTraversable(Cell c) const { return traversableCells(blockOf(c)) & bitOf(c); }
  /// Like isTraversable, for each cell of a block: bit 4 (y mod 4) + (x mod 4).
  unsigned traversableCells(Cell block) const { return blocks_.at(block) & kAllCells; }
  /// Those of them that the robot's centre has been in.
  unsigned passedCells(Cell block) const { return blocks_.at(block) >> kCellsOfBlock; }

  /// Whether it is occupied, not merely too near to what is.
  bool isObstacle(Cell c) const { return cells_.at(c).state == CellState::kOccupied; }

  double clearance() const { return clearance_; }

 private:
  struct Place {
    std::uint16_t near = 0;   ///< obstacles that come nearer to its centre than the clearance
    std::uint16_t close = 0;  ///< those of them that do by a cell's side
    CellState state = CellState::kUnknown;
    bool is_open = false, is_passed = false;

    bool isPassed() const;
  };
  struct Grown {
    Cell offset;
    bool is_close;
  };

  void grow(Cell obstacle, int count);
  void settle(Cell c, Place& place);

  double clearance_;
  std::vector<Grown> disc_;  ///< the cells that an obstacle comes near to
  TiledGrid<Place> cells_;
  /// How many cells a block has, and a bit for each.
  static constexpr unsigned kCellsOfBlock = kBlock * kBlock, kAllCells = 0xFFFF;
  TiledGrid<std::uint32_t> blocks_;  ///< traversable cells, then passed ones, a bit each
};

/// Cells that paths may not lead through, a bit each, by the blocks of the free space.
using BlockedCells = TiledGrid<std::uint16_t>;

/// Where paths may lead: the free space without the cells that are blocked. A cell that the robot
/// has been in stays open. It refers to both.
class PassableSpace {
 public:
  PassableSpace(const FreeSpace& space) : space_(space) {}  // nothing is blocked
  PassableSpace(const FreeSpace& space, const BlockedCells& blocked)
      : space_(space), blocked_(&blocked) {}

  bool isTraversable(Cell c) const {
    return traversableCells(FreeSpace::blockOf(c)) & FreeSpace::bitOf(c);
  }
  /// See FreeSpace::traversableCells().
  unsigned traversableCells(Cell block) const {
    const unsigned open = space_.traversableCells(block);
    const unsigned blocked = blocked_ ? blocked_->at(block) : 0u;
    return blocked ? (open & ~blocked) | space_.passedCells(block) : open;
  }
  bool isObstacle(Cell c) const { return space_.isObstacle(c); }

 private:
  const FreeSpace& space_;
  const BlockedCells* blocked_ = nullptr;
};

}  // namespace cca
