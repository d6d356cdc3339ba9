// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "navigation/world/free_space.hpp"

namespace cca {

/// Lengths of the shortest paths from one place to all others, over blocks of 4 x 4 cells.
///
/// A node is a connected part of a block's traversable cells, so a passage one cell wide is kept
/// and a wall one cell thin is not crossed. Dijkstra with a bucket queue; 8-connected, so a length
/// is 0 to 8 % above the Euclidean one in the open, where of all equally short paths only the one
/// that goes diagonally first is followed [Harabor & Grastien 2011].
class DistanceField {
 public:
  static constexpr double kUnreached = std::numeric_limits<double>::infinity();

  /// Searches anew. @param start    a cell; where it is not traversable, or no way leads half a
  ///                                metre away from it, the nearest one within half a metre where
  ///                                that is otherwise; else nothing is reached.
  /// @param until    the search may end as soon as the way to this cell is known; other ways are
  ///                 then known only as far as they are not longer.
  /// Cost: O(blocks reached), without clearing the last search.
  void search(const PassableSpace& space, double resolution, Cell start,
              std::optional<Cell> until = std::nullopt);

  /// m, from the start to the block that holds a cell; kUnreached where no path is known.
  double distanceTo(Cell c) const;
  bool isReached(Cell c) const { return distanceTo(c) < kUnreached; }

  /// The blocks of the shortest path, start first; empty where unreached.
  std::vector<Cell> blocksTo(Cell c) const;

  /// The traversable cell the search began at. Meaningful where isStarted().
  Cell start() const { return start_; }
  bool isStarted() const { return started_; }

 private:
  static constexpr int kParts = 2;  ///< parts of a block that are told apart
  static constexpr std::uint16_t kStraight = 12, kDiagonal = 17;  // twelfths of a block's side
  struct Part {
    std::uint32_t cost = 0;
    std::uint16_t cells = 0;  ///< the part's cells; 0: none
    bool settled = false;
    std::int8_t from = -1;       ///< neighbour that the path comes from
    std::int8_t from_part = -1;  ///< and its part
    bool from_open = false;      ///< all around that one was open
  };
  struct Node {
    std::uint32_t search = 0;  ///< number of the search that wrote this
    std::array<Part, kParts> parts;
  };
  struct Entry {
    Cell block;
    int part;
    std::uint32_t cost;
  };
  /// A block beside another, and what of it can be entered from there.
  struct Passage {
    Cell block;
    unsigned open;   ///< all traversable cells of the block
    unsigned entry;  ///< one of them
    std::int8_t from = -1, from_part = -1;
    bool from_open = false;
  };
  const Part* partOf(Cell c) const;
  void expand(const PassableSpace& space, const Part& here, const Entry& entry);
  unsigned relax(Node& node, const Passage& to, std::uint32_t cost);

  TiledGrid<Node> nodes_;
  std::uint32_t search_ = 0;
  std::array<std::vector<Entry>, 32> queue_;
  std::size_t waiting_ = 0;
  double unit_ = 1.0;  ///< m, of a cost
  Cell start_;
  bool started_ = false;
};

/// Cells, 0.5 m: past the clearance of a place beside a wall, or of a robot too near to one.
inline constexpr int kBesideWalls = 10;

/// The nearest traversable cell to c, by rings of growing Chebyshev distance; c itself first.
/// @return whether there is one within `reach` cells; then it is in `found`.
bool nearestTraversable(const PassableSpace& space, Cell c, int reach, Cell& found);

/// Whether every cell that a straight line between two points crosses is traversable.
/// @param a,b  in cells (metres / resolution).
bool isClearLine(const PassableSpace& space, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The shortest known path, pulled tight: corner points from the field's start to `goal`.
///
/// Cells are searched only in the blocks of the coarse path and beside them.
/// @return  m, map frame; empty where no known path leads there.
std::vector<Eigen::Vector2d> shortestPath(const PassableSpace& space, double resolution,
                                          const DistanceField& field, Cell goal);

/// m. 0 for fewer than two points.
double pathLength(const std::vector<Eigen::Vector2d>& path);

}  // namespace cca
