// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "cca_mrpt/navigation/goals/view_points.hpp"
#include "cca_mrpt/navigation/place/known_place.hpp"

namespace cca {

/// The places to look at the frontiers from: what a goal is chosen among.
///
/// A view point is the place of the shortest way that sees a point up to two metres behind a
/// frontier. Small frontiers are rests: they are looked at in passing, or by LastLook.
class FrontierViews {
 public:
  /// @param smallest_gain      m^2, frontiers that promise less are left.
  /// @param smallest_frontier  cells, likewise.
  FrontierViews(double smallest_gain, std::size_t smallest_frontier)
      : smallest_gain_(smallest_gain), smallest_frontier_(smallest_frontier) {}

  /// Only what lies inside a polygon (m, map frame) counts. Fewer than three corners: no limit.
  void limitTo(std::vector<Eigen::Vector2d> polygon) { limits_ = std::move(polygon); }

  bool isWithinLimits(const KnownPlace& place, Cell c) const;

  /// Looks at all frontiers anew, by the ways last found; the sixty nearest to `here` where there
  /// are more.
  /// Cost: O(frontier cells), and a bounded number of view points.
  void find(const KnownPlace& place, Cell here);

  /// Where to see a target from, without its gain; empty where no reached place inside the limits
  /// sees it.
  std::optional<ViewPoint> viewOf(const KnownPlace& place, Cell target) const;

  /// Adds the present goal, in place of the view point of much the same frontier: frontiers are
  /// grouped anew each time, so it may have got another target.
  /// @return false where the goal's target can no more be seen from anywhere; nothing is added.
  bool keep(const KnownPlace& place, const ViewPoint& goal);

  const std::vector<ViewPoint>& viewPoints() const { return view_points_; }
  /// Places at the frontiers themselves, those of rests left out: to drive in there.
  const std::vector<ViewPoint>& entries() const { return entries_; }
  /// m, from how far off a target counts as seen.
  double reach(const KnownPlace& place) const;

 private:
  std::vector<Frontier> nearestFrontiers(const KnownPlace& place, Cell here) const;
  std::optional<ViewPoint> viewOf(const KnownPlace& place, const Frontier& frontier) const;
  std::optional<Cell> entryAt(const KnownPlace& place, Cell middle) const;

  double smallest_gain_;
  std::size_t smallest_frontier_;
  std::vector<Eigen::Vector2d> limits_;
  std::vector<ViewPoint> view_points_, entries_;
};

}  // namespace cca
