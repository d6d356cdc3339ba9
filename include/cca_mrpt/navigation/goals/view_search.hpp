// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/navigation/goals/view_points.hpp"
#include "cca_mrpt/navigation/place/known_place.hpp"

namespace cca {

/// What there is to see, and the best place to look from: all places that the robot can reach are
/// asked what is expected to be seen from there.
///
/// One place in every other block of the free space (0.2 m), as it becomes known. When none of
/// these is worth its way, one in every block is asked, and again when much has been seen since: a
/// few centimetres count beside a corner, and what was in the way may have gone. The nearest come
/// first, a bounded number of looks at a time.
class ViewSearch {
 public:
  /// What a view point must fulfil beyond its gain.
  using Filter = std::function<bool(const ViewPoint&)>;

  /// @param smallest_gain      m^2, places that promise less are left.
  /// @param smallest_frontier  cells; what lies behind smaller frontiers does not count.
  /// @param worth              m of way that an unseen square metre is worth; likewise.
  ViewSearch(double smallest_gain, std::size_t smallest_frontier, double worth)
      : smallest_gain_(smallest_gain), smallest_frontier_(smallest_frontier), worth_(worth) {}

  /// The best place to look from by a strategy, by the ways last found, of those that are worth
  /// their way; it stays among the places. Asks places first that were not asked yet.
  /// @return empty if there is none, or not before another call, see isUnderWay().
  /// Cost: O(known blocks), and a bounded number of looks.
  std::optional<ViewPoint> next(const KnownPlace& place, Strategy strategy, const Filter& filter);

  /// Few places that see all between them that is worth its way: those that promise most for their
  /// way first, each asked anew, and none that is there for what another one looks into as well, by
  /// where the unknown begins.
  /// Cost: O(places found) lines of sight, and a bounded number of looks.
  std::vector<ViewPoint> stops(const KnownPlace& place, const Filter& filter);

  /// What is looked at on the way to a goal, for it would cost more later: the place of the least
  /// detour for what is expected, by a metre at most, that is nearer than the goal and worth its
  /// way, and that is there to see what is not in view from the goal.
  /// @return empty if there is none. Cost: O(places found) lines of sight, and few looks.
  std::optional<ViewPoint> inPassing(const KnownPlace& place, const Filter& filter,
                                     const ViewPoint& goal);

  /// The best of the places found that are there to see something else than the chosen ones and
  /// each other, two metres apart at least, as they were when they were asked; the best first. For
  /// people. Cost: O(places found) for each.
  std::vector<ViewPoint> nextBest(const KnownPlace& place, Strategy strategy, const Filter& filter,
                                  std::vector<ViewPoint> chosen, std::size_t most) const;

  /// Whether a target is in view of a place found so far that the ways last found lead to.
  bool canBeSeen(const KnownPlace& place, Cell target) const;

  /// The place was made anew: all places are asked again.
  void forget() { *this = ViewSearch(smallest_gain_, smallest_frontier_, worth_); }

  /// The places that were left when next() found none that is worth its way, or only such as the
  /// filter refused, with their ways.
  const std::vector<ViewPoint>& left() const { return found_; }
  /// Likewise: what the best of those promises that are not worth their way. For people.
  std::string whatIsLeft() const;

  /// Whether there are places that have not been asked yet.
  bool isUnderWay() const { return is_under_way_; }

 private:
  void findPlaces(const KnownPlace& place);
  bool canBeBetter(double best) const;
  void askPlaces(const KnownPlace& place, double best);
  /// Nor refused by the filter.
  bool isWorthItsWay(const ViewPoint& view, const Filter& filter) const;
  std::optional<ViewPoint> choose(const KnownPlace& place, Strategy strategy, const Filter& filter);
  ViewPoint lookFrom(const KnownPlace& place, Cell cell);

  double smallest_gain_;
  std::size_t smallest_frontier_;
  double worth_;
  bool is_under_way_ = false;
  int looks_left_ = 0;             ///< that may be made in this call, in sixteenths
  CellSet openings_;               ///< of now
  std::vector<ViewPoint> places_;  ///< not asked yet, the nearest last
  TiledGrid<char> has_place_{0};   ///< whether a block's place was ever put among them
  int apart_ = 2;                  ///< blocks, between places
  std::size_t revealed_then_ = 0;  ///< cells, when all were asked again
  /// As they were when they were asked: gains only become less as more is seen.
  std::vector<ViewPoint> found_;
};

/// The way that a robot has driven beyond what the places that it saw meanwhile were worth: it
/// grows by each metre, and falls by the worth of all that is newly seen, to zero at the least.
/// Where much is unpaid, what is left will not show what it promises either.
class UnpaidWay {
 public:
  /// @param worth  m of way that a newly seen square metre is worth, >= 0.
  explicit UnpaidWay(double worth) : worth_(worth) {}

  /// Takes where the robot is (m, map frame, finite), and the area seen so far (m^2). Where that
  /// has become less, the place was made anew: nothing new was seen.
  void note(const Eigen::Vector2d& robot_map, double seen);

  double metres() const { return metres_; }

 private:
  double worth_, metres_ = 0.0, seen_ = 0.0;
  std::optional<Eigen::Vector2d> last_place_;
};

}  // namespace cca
