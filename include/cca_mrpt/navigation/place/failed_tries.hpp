// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/navigation/place/free_space.hpp"

namespace cca {

/// How a try to see something failed.
enum class Failure {
  kWayLost,      ///< half-way there: somebody in the way, or a passage that looks open from afar
  kNothingSeen,  ///< it was reached, and what it was to show was not seen
  kNotReached,   ///< in its time, or by proof
};

/// The one memory of what was tried in vain.
///
/// Targets that failed are set aside until the map has changed, by the number of cells that the
/// grid has ever come to know (`revealed`). The first lost way alone is no failure yet. Targets
/// within 15 cm of each other are one.
///
/// Ways that look free and that the robot could not drive, passages of about its own width or
/// panes, are shut: every goal behind one would be tried in turn. Where nothing else is left they
/// are tried again, until the robot has been held six times within 30 cm; then they stay shut until
/// the map has changed.
class FailedTries {
 public:
  /// At one place. Of 30 explorations in which the way leads through passages of 53 to 58 cm, nine
  /// end before it with 3, two with 5, one with 6; but each takes 14 s before a pane.
  static constexpr int kMostTries = 6;

  /// Notes a failure. @param held_at  where the robot got no farther, where that is what failed.
  /// @return whether the target is set aside by it. Cost: O(tries), as of all that follows.
  bool add(Cell target, Failure failure, std::size_t revealed, std::optional<Cell> held_at = {});

  /// Whether it was set aside, and less than 10 m^2 have been seen since then.
  bool isAside(Cell target, std::size_t revealed) const;

  /// How many tries in a row ended with the robot held at the same place, within 30 cm: each
  /// further one would take its time in vain.
  int timesHeld() const;

  /// Bars the first 60 cm of a way, 25 cm wide; cells that the robot has been in stay open.
  /// @param way       corners, m, map frame, from where the robot got no farther.
  /// @param revealed  cells that the grid has ever come to know.
  /// Cost: O(1).
  void bar(const std::vector<Eigen::Vector2d>& way, double resolution, std::size_t revealed,
           FreeSpace& space);

  /// Opens what was barred and may be tried again. @return whether there was any.
  /// Cost: O(cells barred + tries^2).
  bool open(std::size_t revealed, FreeSpace& space);

  /// The map has been made anew, and as much of it is revealed now: bars in its space what was
  /// barred before.
  void move(const CellMove& moved, std::size_t revealed, FreeSpace& space);

 private:
  struct Try {
    Cell target;
    Failure failure;
    bool is_aside;
    std::size_t revealed_then;
    std::optional<Cell> held_at;
  };

  struct Barred {
    Cell held_at;
    std::vector<Cell> cells;  ///< none where they were opened again
    std::size_t revealed_then;
  };
  bool staysShut(const Barred& barred, std::size_t revealed) const;

  std::vector<Try> tries_;
  std::vector<Barred> barred_;
};

}  // namespace cca
