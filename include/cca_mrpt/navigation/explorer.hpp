// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/navigation/drive/progress.hpp"
#include "cca_mrpt/navigation/drive/tangent_bug/tangent_bug.hpp"
#include "cca_mrpt/navigation/goals/global_planner.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What the robot knows at one moment.
struct Observation {
  Scan scan;  ///< taken at scan.T_map_sensor
  Pose2 T_map_robot;
  Velocity velocity;  ///< as measured
  double time = 0.0;  ///< s, never falling
  /// Whether T_map_robot is known. Where it is not, the robot drives on by its wheels and what it
  /// sees, and nothing is added to the map.
  bool is_localised = true;
  /// m, map frame: what other sensors see of what the laser may see, too (other lasers). The robot
  /// does not drive into it.
  std::vector<Eigen::Vector2d> seen_elsewhere{};
  /// m, map frame: what no laser sees (bumpers, cliff sensors). Ways lead around it, too.
  std::vector<Eigen::Vector2d> hazards{};
};

enum class ExplorationStatus {
  kExploring,
  kReturning,
  kPaused,
  kFinished,
  kSent,         ///< on the way to where it was sent, see Explorer::sendTo()
  kArrived,      ///< there; told once
  kUnreachable,  ///< not there, and it has given up; told once
};

/// "exploring", "returning", "paused", "finished", "driving", "arrived" or "unreachable".
const char* nameOf(ExplorationStatus status);

/// What the robot shall do next.
struct Action {
  Velocity velocity;
  std::optional<Eigen::Vector2d> goal;  ///< m, map frame
  ExplorationStatus status = ExplorationStatus::kExploring;
  std::string reason;  ///< one sentence for people: why it drives there, or why it has finished
  double goal_heading = 0.0;  ///< rad, map frame: where to look from the goal, see leaveDriving()
};

/// What has become of a goal that somebody else was to drive to.
enum class DriveOutcome { kReached, kFailed };

/// What drives between the robot and its goal.
enum class PathKind {
  kKnownSpace,  ///< the corners of the shortest known way, Tangent Bug between them
  kPaper,       ///< Tangent Bug alone, straight to the goal
};

/// As options and files name them.
inline constexpr std::pair<const char*, PathKind> kPathNames[] = {
    {"known_space", PathKind::kKnownSpace}, {"paper", PathKind::kPaper}};

struct ExplorerParameters : GlobalPlannerParameters {
  PathKind path = PathKind::kKnownSpace;
  bool return_to_start = false;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(ExplorerParameters& p, Field&& field) {
  field("strategy", p.strategy, kStrategyNames,
        "how the next goal is chosen; greedy is the paper's");
  field("path", p.path, kPathNames,
        "way-points along what is known to be free, or (paper) Tangent Bug straight to the goal");
  field("worth", p.worth, 0.0, 1e6, "m/m^2",
        "way that an unseen square metre is worth: exploration ends when nothing that is "
        "left is worth its way");
  field("smallest_gain", p.smallest_gain, 0.0, 100.0, "m^2",
        "exploration ends when no reachable frontier promises more");
  field("return_to_start", p.return_to_start, "drive back to where it began when all is explored");
}

/// From what the robot knows at a moment to a velocity: scan -> exploration grid -> goal -> Tangent
/// Bug -> velocity. It does not map: see ExplorationSession.
///
/// It ends by itself: each goal has its time, a goal that is not reached in time or proves
/// unreachable is set aside, and a place of finite size has finitely many goals.
class Explorer {
 public:
  Explorer(const RobotParameters& robot, const ExplorerParameters& parameters);

  /// Takes what is observed, and decides.
  Action step(const Observation& observation);

  /// Takes a scan of another laser than the one that the robot drives by: it adds to all that is
  /// known. @param scan  at scan.T_map_sensor. @param T_map_robot  at its time.
  void observe(const Scan& scan, const Pose2& T_map_robot);

  /// Takes a correction of the past, of which the next observation knows already. All that is
  /// remembered of places is made anew or moves along; the robot drives on as it did. Cost: that of
  /// the scans.
  void correct(const PastScans& past);

  /// Somebody else drives to the goals of the actions, whose velocities are zero: a navigation that
  /// knows of footprints that are no discs. Without an outcome, a goal has its time as any other.
  /// Where the robot's pose is unknown there is no goal. To be called before the first step.
  void leaveDriving() { leaves_driving_ = true; }
  /// What has become of the goal of the last action; heeded by the next step. One that failed is
  /// set aside as one that proved unreachable.
  void noteOutcome(DriveOutcome outcome) { outcome_ = outcome; }

  /// See GlobalPlanner::explainTo().
  void explainTo(DecisionObserver observer) { planner_.explainTo(std::move(observer)); }

  /// The robot moves otherwise from now on: its speeds, accelerations and latency (the rest stays).
  /// What the odometry has shown is learned anew where accelerations or latency change.
  void changeMotion(const RobotParameters& robot);

  /// While paused it observes, and stands still.
  void pause(bool paused) { is_paused_ = paused; }
  /// Gives up exploring and drives back to where it began.
  void returnToStart() { is_returning_ = true; }
  /// Drives to a place of the map and turns to its heading, before all else and though paused; then
  /// all is as it was before. A place that for ten seconds no known way has led to (the robot
  /// stands there no nearer than kBesideGoal), or where the robot has got no farther twice, is
  /// given up. The place moves along where the past is corrected. Not together with leaveDriving().
  void sendTo(const Pose2& T_map_goal);
  /// Not any more.
  void recall() { errand_.reset(); }
  /// Whether it is on the way to where it was sent.
  bool isSent() const { return errand_.has_value(); }
  static constexpr double kBesideGoal = 0.25;  ///< m

  /// Exploration stays inside a polygon (m, map frame). To be called before the first step.
  void limitTo(std::vector<Eigen::Vector2d> polygon) { planner_.limitTo(std::move(polygon)); }

  /// What the odometry has shown of how the base obeys.
  const ShownMotion& shownMotion() const { return tangent_bug_.motion().shown(); }
  const ExplorationGrid& grid() const { return planner_.place().grid(); }
  const GlobalPlanner& planner() const { return planner_; }
  /// Whether it has finished although a way that the robot's own radius may admit leads to much
  /// that is in view: a square metre at least, and a twentieth of all that was seen. What no robot
  /// of its size gets to is not missing.
  bool leavesMuch() const;

 private:
  void excuse(double time);
  Action decide(const Observation& observation);
  void heedOutcome(const Eigen::Vector2d& robot_map);
  void turnTowards(const Eigen::Vector2d& p_map, const Pose2& T_map_robot, Action& action) const;
  void turnOnTheSpot(double rate, Action& action) const;
  Action explore(const Observation& observation);
  Action lookAround(const Observation& observation);
  Action goHome(const Observation& observation);
  Action runErrand(const Observation& observation);
  Action endErrand(ExplorationStatus status, const std::string& reason);
  void followWay(const std::vector<Eigen::Vector2d>& way, const Eigen::Vector2d& end,
                 const Observation& observation, Action& action);
  Velocity driveTo(const Eigen::Vector2d& way_point_map, const Observation& observation);

  ExplorerParameters parameters_;
  RobotParameters robot_;
  GlobalPlanner planner_;
  /// The frame that the local planner drives in: where the map is corrected, the robot goes on
  /// smoothly in it.
  Pose2 T_drive_map_;
  TangentBug tangent_bug_;  ///< in the drive frame
  WayProgress progress_;
  std::optional<Pose2> T_map_start_;
  std::optional<Eigen::Vector2d> way_point_;  ///< drive frame
  std::optional<Pose2> T_map_turned_;  ///< where somebody else is to turn it to, looking around
  std::optional<DriveOutcome> outcome_;
  bool leaves_driving_ = false;
  bool is_paused_ = false;
  bool is_returning_ = false;
  bool was_returning_ = false;  ///< at the last step
  std::string why_finished_;
  /// A place that it was sent to.
  struct Errand {
    Pose2 T_map_goal;
    ProgressClock without_way;
    int held = 0;  ///< how often it got no farther
  };
  std::optional<Errand> errand_;
  int errands_ = 0;  ///< so far
};

}  // namespace cca
