// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "navigation/planning/planning_scene.hpp"
#include "navigation/planning/view_points.hpp"

namespace cca {

/// Finds the best viewpoint: evaluates from which reachable place how much is expected to be seen.
///
/// There is one candidate in every other block of the free space (0.2 m), as it becomes known. When
/// none of these is worth its way there is one in every block, and again when much has been seen
/// since: beside a corner a few centimetres count, and an obstacle may have gone. The nearest are
/// evaluated first, a bounded number in each call.
class ViewSearch {
 public:
  /// What a viewpoint must fulfil beyond its gain.
  using Filter = std::function<bool(const ViewPoint&)>;

  /// @param smallest_gain      m^2; viewpoints that promise less do not count.
  /// @param smallest_frontier  cells; what lies behind smaller frontiers does not count.
  /// @param worth              m of way that an unseen square metre is worth; a viewpoint that
  ///                           costs more does not count.
  ViewSearch(double smallest_gain, std::size_t smallest_frontier, double worth)
      : smallest_gain_(smallest_gain), smallest_frontier_(smallest_frontier), worth_(worth) {}

  /// The best viewpoint by a strategy and by the paths last found. It stays among the viewpoints.
  /// New candidates are evaluated first.
  /// @return empty if there is none, or not before another call, see isUnderWay().
  /// Cost: O(known blocks), and a bounded number of evaluations.
  std::optional<ViewPoint> next(const PlanningScene& scene, Strategy strategy,
                                const Filter& filter);

  /// The viewpoint on the way to a goal, for it would cost more later: that of the least detour for
  /// what is expected, by a metre at most, nearer than the goal and worth its way, whose target is
  /// not in view from the goal.
  /// @return empty if there is none. Cost: O(viewpoints) lines of sight, and few evaluations.
  std::optional<ViewPoint> onTheWay(const PlanningScene& scene, const Filter& filter,
                                    const ViewPoint& goal);

  /// The best viewpoints whose targets lie two metres at least from those of the chosen ones and
  /// from each other, as they were last evaluated; the best first. For people.
  /// Cost: O(viewpoints) for each.
  std::vector<ViewPoint> nextBest(Strategy strategy, const Filter& filter,
                                  std::vector<ViewPoint> chosen, std::size_t most) const;

  /// Whether a target is in view of a viewpoint that the paths last found lead to.
  bool canBeSeen(const PlanningScene& scene, Cell target) const;

  /// The world was made anew: all places are evaluated again.
  void forget() { *this = ViewSearch(smallest_gain_, smallest_frontier_, worth_); }

  /// The viewpoints that were left when next() found none that is worth its way, or only such as
  /// the filter refused, with their ways.
  const std::vector<ViewPoint>& left() const { return viewpoints_; }
  /// Likewise: what the best of those promises that are not worth their way. For people.
  std::string whatIsLeft() const;

  /// Whether there are candidates that have not been evaluated yet.
  bool isUnderWay() const { return is_under_way_; }

 private:
  void findCandidates(const PlanningScene& scene);
  bool canBeBetter(double best) const;
  void evaluateCandidates(const PlanningScene& scene, double best);
  /// Nor refused by the filter.
  bool isWorthItsWay(const ViewPoint& view, const Filter& filter) const;
  std::optional<ViewPoint> choose(const PlanningScene& scene, Strategy strategy,
                                  const Filter& filter);
  ViewPoint evaluateViewpoint(const PlanningScene& scene, Cell cell);

  double smallest_gain_;
  std::size_t smallest_frontier_;
  double worth_;
  bool is_under_way_ = false;
  int looks_left_ = 0;                 ///< evaluations left in this call, in sixteenths
  CellSet frontier_cells_;             ///< of now
  std::vector<ViewPoint> candidates_;  ///< not evaluated yet, the nearest last
  TiledGrid<char> has_candidate_{0};   ///< whether a block was ever among them
  int apart_ = 2;                      ///< blocks, between candidates
  std::size_t revealed_then_ = 0;      ///< cells, when all began anew
  /// As they were when they were evaluated: gains only become less as more is seen.
  std::vector<ViewPoint> viewpoints_;
};

}  // namespace cca
