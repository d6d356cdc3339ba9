// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/geometry/polygon.hpp"
#include "cca_mrpt/navigation/explained_decision.hpp"
#include "cca_mrpt/navigation/explorer_parameters.hpp"
#include "navigation/goal_outcome.hpp"
#include "navigation/planning/planning_scene.hpp"
#include "navigation/planning/travel_budget.hpp"
#include "navigation/planning/unreached_parts.hpp"
#include "navigation/planning/view_points.hpp"
#include "navigation/planning/view_search.hpp"

namespace cca {

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
  /// Number of the goal, from 1 on; kLookAround where looking around; else 0.
  int goal = 0;
  static constexpr int kLookAround = -1;  ///< goals begin at 1, home and errands are below
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

/// The paper's global planner (Step 0): sets one goal after the other until no reachable frontier
/// of useful size is left; see docs/exploration.md. It changes nothing of the world.
///
/// A goal is the best of all places to look from (ViewSearch) or what is seen on the way there; by
/// the strategies of others, a place at a frontier as long as there is one. It is given up as soon
/// as what it is to show has been seen, or the path is blocked.
class GlobalPlanner {
 public:
  /// @param radius  m, of the robot: what it may pass, were there need.
  explicit GlobalPlanner(const GlobalPlannerParameters& parameters = {}, double radius = 0.25);

  /// Decides anew where that is due.
  /// @param outcome  of the last plan. A goal that was reached is not tried again until the map has
  ///                 changed, if it shows nothing new. Where the robot got no farther on a path,
  ///                 that is blocked; where what the goal is to show can be seen by no other path,
  ///                 it is tried once more. A goal that this happens to twice, or that by no other
  ///                 path can be seen and has had its time, is blacklisted; so is one that failed
  ///                 without a lost path. The sixth one in a row at the same place ends the
  ///                 exploration.
  /// Cost: where a decision is made O(known blocks) for the paths, and a bounded number of view
  /// points.
  const Plan& update(const WorldModel& world, const Eigen::Vector2d& robot_map,
                     const GoalOutcome& outcome = {});

  /// The shortest known path from one place to another; empty where there is none. It leads along
  /// places where the robot got no farther only where there is no other, and not after six tries.
  /// @param lost_path  see GoalOutcome: blocked before.
  std::vector<Eigen::Vector2d> pathTo(const WorldModel& world, const Eigen::Vector2d& robot_map,
                                      const Eigen::Vector2d& goal_map,
                                      const std::vector<Eigen::Vector2d>& lost_path = {});

  /// Exploration stays inside a polygon (m, map frame); fewer than three corners: no limit.
  void limitTo(Polygon polygon) { limits_ = std::move(polygon); }

  /// Each decision from now on is told to an observer, with what it was made of. It decides
  /// nothing.
  void explainTo(DecisionObserver observer) { observer_ = std::move(observer); }

  /// The world has been made anew: goals and blocked paths go with it. The next update finds the
  /// path to the same goal anew. @param moved  see WorldModel::correct().
  void correct(const WorldModel& world, const PastScans& past, const CellMove& moved);

  const Plan& plan() const { return plan_; }

 private:
  PlanningScene sceneOf(const WorldModel& world) { return {world, blacklist_, distances_}; }
  void applyOutcome(PlanningScene& scene, const Eigen::Vector2d& robot_map,
                    const GoalOutcome& outcome);
  void abandonPath(PlanningScene& scene, const Eigen::Vector2d& robot_map,
                   const GoalOutcome& outcome);
  bool isGoalUnseen(const WorldModel& world) const;
  bool goalStands(const PlanningScene& scene) const;
  bool pathStands(const PlanningScene& scene) const;
  void advance(const PlanningScene& scene, const Eigen::Vector2d& robot_map);
  void replan(PlanningScene& scene, const Eigen::Vector2d& robot_map);
  bool takePathTo(const PlanningScene& scene, Cell goal, const Eigen::Vector2d& robot_map);
  bool isTimeToReconsider(const ExplorationGrid& grid, const Eigen::Vector2d& robot_map) const;
  void decide(PlanningScene& scene, const Eigen::Vector2d& robot_map);
  ViewSearch::Filter openOnes(const PlanningScene& scene) const;
  bool isWithinLimits(const Eigen::Vector2d& p_map) const;
  bool driveToFrontier(PlanningScene& scene, const Eigen::Vector2d& robot_map);
  void lookAround();
  /// A place to go to, how it was found, and what else was weighed: for people.
  struct Choice {
    ViewPoint view;
    std::string found;
    DecisionRule rule;
    std::vector<ViewPoint> weighed;  ///< it among them
  };
  Choice nextStop(const PlanningScene& scene, const ViewPoint& best);
  void explain(const ExplorationGrid& grid, const Eigen::Vector2d& robot_map,
               const Choice& choice) const;
  bool search(PlanningScene& scene, const Eigen::Vector2d& robot_map);
  void dropGoal(PlanningScene& scene, Failure failure, std::optional<Cell> held_at = {});
  void finish(PlanningScene& scene, const Eigen::Vector2d& robot_map);
  bool drivesInVain(const ExplorationGrid& grid) const;
  std::optional<std::string> whyGivenUp(const PlanningScene& scene) const;
  void driveTo(PlanningScene& scene, const ViewPoint& chosen, const Eigen::Vector2d& robot_map,
               const std::string& reason);

  GlobalPlannerParameters parameters_;
  double radius_;
  GoalBlacklist blacklist_;
  DistanceField distances_;
  ViewSearch view_search_;
  Polygon limits_;  ///< map frame
  TravelBudget budget_;
  bool has_looked_around_ = false;  ///< from the start
  bool is_corrected_ = false;       ///< since the last decision
  std::optional<ViewPoint> goal_;
  struct {
    Eigen::Vector2d robot_map = Eigen::Vector2d::Zero();
    std::size_t revealed = 0;  ///< cells
  } decided_;                  ///< when the last decision was made
  struct {
    std::vector<UnreachedPart> parts;
    std::optional<std::size_t> revealed;  ///< cells, when they were found
  } unreached_;
  int goals_ = 0;  ///< set so far
  Plan plan_;
  DecisionObserver observer_;  ///< may be none
};

}  // namespace cca
