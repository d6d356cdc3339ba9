// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"

namespace cca {

/// Neighbouring frontier cells: free, with the unknown on the other side [Yamauchi 1997].
struct Frontier {
  std::vector<Cell> cells;
  Cell middle;  ///< the member nearest to the mean of all
};

/// Whether a cell is free, or presumed so, and a side neighbour is unknown. A presumed wall is not
/// unknown here. At the end of the laser's range most cells of a frontier are presumed ones:
/// without them it falls to pieces as small as a beam, and a room behind it would not be missed.
bool isFrontier(const ExplorationGrid& grid, Cell c);

/// Whether a cell is free, or presumed so, and beside the face of an obstacle that was not seen.
bool isBesideUnseenFace(const ExplorationGrid& grid, Cell c);

/// The frontier cells of a grid, or others that their neighbours make such, kept up to date cell by
/// cell.
class FrontierCells {
 public:
  using Rule = bool (*)(const ExplorationGrid&, Cell);
  /// @param is_one  may ask for a cell and its side neighbours.
  explicit FrontierCells(Rule is_one = isFrontier) : is_one_(is_one) {}

  /// Cost: cells changed.
  void update(const ExplorationGrid& grid, const std::vector<Cell>& changed);

  /// All frontier cells; the order depends only on the grid's history.
  const CellSet& all() const { return all_; }
  const std::vector<Cell>& cells() const { return all_.cells(); }

  /// Groups of 8-connected frontier cells, none longer than `extent` cells in any direction: a
  /// longer line is cut into pieces. Cost: O(frontier cells).
  std::vector<Frontier> frontiers(int extent) const;

 private:
  void review(const ExplorationGrid& grid, Cell c);

  Rule is_one_;
  CellSet all_;
};

}  // namespace cca
