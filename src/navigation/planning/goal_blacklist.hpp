// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "navigation/world/free_space.hpp"

namespace cca {

/// How a try to see something failed.
enum class Failure {
  kPathLost,     ///< half-way there: somebody in the way, or a passage that looks open from afar
  kNothingSeen,  ///< it was reached, and what it was to show was not seen
  kNotReached,   ///< in its time, or by proof
};

/// The one memory of what was tried in vain. The world model knows nothing of it.
///
/// Targets that failed are blacklisted until the map has changed, by the number of cells that the
/// grid has ever come to know (`revealed`). The first lost path alone is no failure yet. Targets
/// within 15 cm of each other are one.
///
/// Paths that look free and that the robot could not drive, passages of about its own width or
/// panes, are blocked: every goal behind one would be tried in turn. Where nothing else is left
/// they are tried again, until the robot has been held six times within 30 cm; then they stay
/// blocked until the map has changed.
class GoalBlacklist {
 public:
  /// At one place. Of 30 explorations in which the way leads through passages of 53 to 58 cm, nine
  /// end before it with 3, two with 5, one with 6; but each takes 14 s before a pane.
  static constexpr int kMostTries = 6;

  /// Notes a failure. @param held_at  where the robot got no farther, where that is what failed.
  /// @return whether the target is blacklisted by it. Cost: O(failures), as of all that follows.
  bool add(Cell target, Failure failure, std::size_t revealed, std::optional<Cell> held_at = {});

  /// Whether it was blacklisted, and less than 10 m^2 have been seen since then.
  bool contains(Cell target, std::size_t revealed) const;

  /// How many tries in a row ended with the robot held at the same place, within 30 cm: each
  /// further one would take its time in vain.
  int timesHeld() const;

  /// Nothing more will be seen from a block of the free space, wherever the laser has looked.
  void addExhausted(Cell c);
  bool isExhausted(Cell c) const { return exhausted_.at(FreeSpace::blockOf(c)); }

  /// Blocks the first 60 cm of a path, 25 cm wide.
  /// @param path      corners, m, map frame, from where the robot got no farther.
  /// @param revealed  cells that the grid has ever come to know.
  /// Cost: O(1).
  void blockPath(const std::vector<Eigen::Vector2d>& path, double resolution, std::size_t revealed);

  /// Opens what was blocked and may be tried again. @return whether there was any.
  /// Cost: O(cells blocked + tries^2).
  bool unblock(std::size_t revealed);

  const BlockedCells& blocked() const { return blocked_; }

  /// The map has been made anew, and as much of it is revealed now: all that is remembered moves.
  void reindex(const CellMove& moved, std::size_t revealed);

 private:
  struct Try {
    Cell target;
    Failure failure;
    bool is_blacklisted;
    std::size_t revealed_then;
    std::optional<Cell> held_at;
  };

  struct BlockedPath {
    Cell held_at;
    std::vector<Cell> cells;  ///< none where they were opened again
    std::size_t revealed_then;
  };
  bool staysBlocked(const BlockedPath& path, std::size_t revealed) const;
  void markBlockedCells();

  std::vector<Try> tries_;
  std::vector<BlockedPath> paths_;
  BlockedCells blocked_;  ///< the cells of all paths
  TiledGrid<char> exhausted_{0};
  std::vector<Cell> exhausted_cells_;  ///< one of each block
};

}  // namespace cca
