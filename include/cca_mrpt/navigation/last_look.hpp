// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cca_mrpt/navigation/goal_selection.hpp"
#include "cca_mrpt/navigation/known_place.hpp"
#include "cca_mrpt/navigation/view_points.hpp"

namespace cca {

/// What is left to see when there is no frontier left to go to: all places that the robot can
/// reach, one or two in each block of the free space (0.2 m), are asked what is unknown in view
/// from there.
///
/// A frontier asks the other way round, from where a point behind it is seen. Through a gap that
/// the robot does not fit through, each place sees another wedge of what lies behind, and a point
/// says little of the wedge. All places at once would be too much work for a step, so they are
/// gone through a bounded number at a time, while the robot stands.
class LastLook {
 public:
  /// What a view point must fulfil beyond its gain.
  using Filter = std::function<bool(const ViewPoint&)>;

  /// @param smallest_gain      m^2, places that promise less are left.
  /// @param smallest_frontier  cells; what lies behind smaller frontiers does not count.
  LastLook(double smallest_gain, std::size_t smallest_frontier)
      : smallest_gain_(smallest_gain), smallest_frontier_(smallest_frontier) {}

  /// Goes through all places anew that are reached by the ways last found.
  void begin(const KnownPlace& place);

  /// The best place to look from by a strategy other than kViewTour, by the ways last found and
  /// what is known by now; it stays among the places. Goes on through the places first, if it has
  /// not been through all of them.
  /// @return empty if there is none, or not before another call, see isUnderWay().
  /// Cost: a bounded number of places, the frontier cells, and O(known blocks) in all for each
  /// begin().
  std::optional<ViewPoint> next(KnownPlace& place, Strategy strategy, const Filter& filter);

  /// Takes out a place that could not be reached, with those around it (0.5 m).
  void drop(Cell place);

  /// Whether there are places that have not been asked yet.
  bool isUnderWay() const { return is_under_way_; }

 private:
  void markFrontiers(KnownPlace& place);
  void goThroughPlaces(const KnownPlace& place);
  std::optional<ViewPoint> choose(const KnownPlace& place, Strategy strategy, const Filter& filter);
  ViewPoint lookFrom(const KnownPlace& place, Cell cell);

  double smallest_gain_;
  std::size_t smallest_frontier_;
  bool is_under_way_ = false;
  Cell first_, last_, block_;  ///< blocks: the corners of what is known, and the next one
  int places_left_ = 0;        ///< that may be asked in this call
  TiledGrid<std::uint32_t> frontier_cells_{0};  ///< the last call that they were marked in
  std::uint32_t call_ = 0;
  /// As they were when they were asked: gains only become less as more is seen.
  std::vector<ViewPoint> found_;
};

}  // namespace cca
