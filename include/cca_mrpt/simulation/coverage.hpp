// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <future>
#include <optional>
#include <vector>

#include "cca_mrpt/simulation/world.hpp"

namespace cca {

/// Cells that a beam of a 360 degree laser crosses from some place that a round robot gets to from
/// the start: what an exploration can see at most.
///
/// The places are those of a lattice of 0.2 m on which the robot touches nothing, wherever in the
/// cell it stands, and that are 4-connected with the free cell nearest to the start; each is looked
/// at with 361 beams and a heading of its own.
/// @param given_up  looked at now and then; once it is set, the cells found so far come back.
/// @return  width * height cells, 1: visible. Cost: (area / 0.04 m^2) * 361 * range / resolution.
std::vector<unsigned char> visibleCells(const World& world, const Eigen::Vector2d& start,
                                        double radius, double max_range,
                                        const std::atomic<bool>& given_up = false);

/// Share of the cells in which a round robot can stand that are 4-connected with the free one
/// nearest to the start, in [0, 1]; 0 where there is none.
double shareReached(const World& world, const Eigen::Vector2d& start, double radius);

/// How much of what can be seen has been seen so far. The visible cells are worked out beside the
/// run, in a thread of its own; results do not depend on when that ends.
class Coverage {
 public:
  /// @param world  must outlive this object.
  Coverage(const World& world, const Eigen::Vector2d& start, double radius, double max_range);
  ~Coverage();

  /// A look around with 361 beams. Cost: cells crossed.
  void look(const Pose2& T_map_sensor);

  /// Where the visible cells are not known yet they never will be: for a run that is to end now.
  void giveUp();

  /// Share of the visible cells seen up to each look, in [0, 1]; empty after giveUp(). Waits for
  /// the visible cells.
  std::vector<double> curve();
  /// Returns once the visible cells are known: from then on sofar() tells.
  void wait() { learnVisible(); }
  /// The last of curve(), or nothing while the visible cells are not known. For people.
  std::optional<double> sofar();

 private:
  void learnVisible();

  const World& world_;
  double max_range_;
  std::atomic<bool> given_up_{false};
  std::future<std::vector<unsigned char>> pending_;
  std::vector<unsigned char> visible_, seen_;
  std::size_t visible_count_ = 0, counted_ = 0, seen_visible_ = 0;
  std::vector<int> seen_order_;            // cells in the order of being seen
  std::vector<std::size_t> seen_at_look_;  // how many of them up to each look
};

}  // namespace cca
