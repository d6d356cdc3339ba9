// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/polygon.hpp"
#include "cca_mrpt/navigation/goals/explained_decision.hpp"
#include "cca_mrpt/navigation/goals/view_points.hpp"
#include "cca_mrpt/navigation/goals/view_search.hpp"
#include "cca_mrpt/navigation/goals/view_tour.hpp"
#include "cca_mrpt/navigation/place/known_place.hpp"
#include "cca_mrpt/navigation/place/unreached_parts.hpp"

namespace cca {

struct GlobalPlannerParameters {
  Strategy strategy = Strategy::kViewTour;
  double smallest_gain = 0.1;         ///< m^2, frontiers that promise less are left
  std::size_t smallest_frontier = 3;  ///< cells, likewise
  double worth = 36.0;                ///< m of way that an unseen square metre is worth
};

enum class PlanPhase {
  /// Before the first scan that shows something, and where it takes some more calls to find out
  /// what is left to see.
  kUndecided,
  kDriving,
  /// At the start, and where no goal is known, not all directions have been looked into from here
  /// (a laser of less than 360 degrees): the robot shall turn on the spot.
  kLookingAround,
  kFinished,
};

/// Where to go next, and how.
struct Plan {
  PlanPhase phase = PlanPhase::kUndecided;
  /// m, map frame, from the robot to the goal: corner points, two at least. Empty but where
  /// driving.
  std::vector<Eigen::Vector2d> path;
  Eigen::Vector2d look_at = Eigen::Vector2d::Zero();  ///< m, map frame: what the goal is to show
  std::string reason;
  /// Where finished: what is in view where the robot could stand, had it found a way there.
  std::vector<UnreachedPart> unreached;
  /// Where finished: not for lack of goals, but because the robot did not get on.
  bool gave_up = false;

  bool isFinished() const { return phase == PlanPhase::kFinished; }
  /// m^2, of all that is unreached, or of that which the robot's radius may admit a way to.
  double unreachedArea() const;
  double passableArea() const;
};

/// The paper's global planner (Step 0): keeps what is known of the place, and sets one goal after
/// the other until no reachable frontier of useful size is left; see docs/exploration.md.
///
/// A goal is the best of all places to look from (ViewSearch) or what is seen in passing on the way
/// there, or where none promises much the first stop of a tour of few of them; by the strategies of
/// others, a place at a frontier as long as there is one. It is given up as soon as what it is to
/// show has been seen, or the way is blocked.
class GlobalPlanner {
 public:
  /// @param clearance  m, kept from known obstacles.
  /// @param radius     m, of the robot: what it may pass, were there need.
  explicit GlobalPlanner(const GlobalPlannerParameters& parameters = {}, double clearance = 0.30,
                         double radius = 0.25);

  /// Takes a scan, and decides anew where that is due. Cost: cells crossed by the scan; a decision
  /// costs O(known blocks) for the ways, and a bounded number of view points.
  const Plan& update(const Scan& scan, const Eigen::Vector2d& robot_map, bool is_placed = true);

  /// What is known. What is added to it counts from the next update on.
  KnownPlace& place() { return place_; }
  const KnownPlace& place() const { return place_; }

  /// Exploration stays inside a polygon (m, map frame); fewer than three corners: no limit.
  void limitTo(Polygon polygon) { limits_ = std::move(polygon); }

  /// Each decision from now on is told to an observer, with what it was made of. It decides
  /// nothing.
  void explainTo(DecisionObserver observer) { observer_ = std::move(observer); }

  /// Takes a correction of the past: what is known is made anew from the scans, and goals and
  /// barred ways go with them. The next update finds the way to the same goal anew. Cost: that of
  /// observing all the scans.
  void correct(const PastScans& past);

  /// Sets the present goal aside until the map has changed, e.g. where it proved unreachable. The
  /// sixth one in a row that this happens to at the same place ends the exploration.
  void setGoalAside();

  /// Says that the robot got no farther on a way (m, map frame), from its beginning on: bars it, or
  /// where what the goal is to show can be seen on no other way, lets it be tried once more. A goal
  /// that this happens to twice, or that on no other way can be seen and has `had_its_time`, is set
  /// aside. Cost: a search over the known blocks, and a line of sight for each place found.
  void leaveWay(const std::vector<Eigen::Vector2d>& way, bool had_its_time);

  /// Says that the robot is as near to the goal as it gets: if there is nothing new to see from
  /// here, the goal is not tried again until the map has changed.
  void noteArrival();

  /// Says that nothing more will be seen from here, wherever the laser has looked.
  void noteLookAround(const Eigen::Vector2d& robot_map);

  /// The shortest known way from one place to another; empty where there is none. It leads along
  /// places where the robot got no farther only where there is no other, and not after six tries.
  std::vector<Eigen::Vector2d> pathTo(const Eigen::Vector2d& robot_map,
                                      const Eigen::Vector2d& goal_map);

  const Plan& plan() const { return plan_; }
  /// Number of goals set so far.
  int goals() const { return goals_; }

 private:
  const ExplorationGrid& grid() const { return place_.grid(); }
  const FreeSpace& space() const { return place_.space(); }
  bool isScanned(const Eigen::Vector2d& p_map) const;
  bool isGoalUnseen() const;
  bool goalStands() const;
  bool pathStands() const;
  void advance(const Eigen::Vector2d& robot_map);
  void replan(const Eigen::Vector2d& robot_map);
  bool takeWayTo(Cell goal, const Eigen::Vector2d& robot_map);
  bool isTimeToReconsider(const Eigen::Vector2d& robot_map) const;
  void decide(const Eigen::Vector2d& robot_map);
  ViewSearch::Filter openOnes() const;
  bool isWithinLimits(Cell c) const;
  bool driveToFrontier(const Eigen::Vector2d& robot_map);
  void lookAround();
  /// A place to go to, how it was found, and what else was weighed: for people.
  struct Choice {
    ViewPoint view;
    std::string found;
    DecisionRule rule;
    std::vector<ViewPoint> weighed;  ///< it among them
    std::vector<double> costs;       ///< of these, where the rule is a tour
  };
  Choice nextStop(const ViewPoint& best);
  void explain(const Eigen::Vector2d& robot_map, const Choice& choice) const;
  std::string promiseOf(const ViewPoint& view) const;
  bool search(const Eigen::Vector2d& robot_map);
  void dropGoal(Failure failure, std::optional<Cell> held_at = {});
  void finish(const Eigen::Vector2d& robot_map);
  bool drivesInVain() const;
  std::optional<std::string> whyGivenUp() const;
  void driveTo(const ViewPoint& chosen, const Eigen::Vector2d& robot_map,
               const std::string& reason);

  GlobalPlannerParameters parameters_;
  double radius_;
  KnownPlace place_;
  ViewSearch view_search_;
  Polygon limits_;  ///< map frame
  UnpaidWay unpaid_way_;
  bool has_looked_around_ = false;  ///< from the start
  bool is_corrected_ = false;       ///< since the last decision
  std::optional<ViewPoint> goal_;
  Eigen::Vector2d decided_at_ = Eigen::Vector2d::Zero();
  std::size_t revealed_then_ = 0;  ///< at the last decision
  std::vector<UnreachedPart> unreached_;
  std::optional<std::size_t> unreached_then_;  ///< cells seen when that was found
  int goals_ = 0;
  Plan plan_;
  DecisionObserver observer_;  ///< may be none
};

}  // namespace cca
