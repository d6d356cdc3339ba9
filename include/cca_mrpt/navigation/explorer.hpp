// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/navigation/explained_decision.hpp"
#include "cca_mrpt/navigation/explorer_parameters.hpp"
#include "cca_mrpt/navigation/observation.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"

namespace cca {

class ActuationModel;
class Driver;
class ExplorationGrid;
class GlobalPlanner;
class ProgressClock;
class WorldModel;
struct Plan;
struct DriveTask;

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
  double goal_heading =
      0.0;  ///< rad, map frame: where to look from the goal, see delegateDriving()
};

/// From what the robot knows at a moment to a velocity. A step senses, plans and acts: the world
/// model takes the observation, the planner sets the goal by that model and by what has become of
/// the last goal, the driver drives. It does not map: see ExplorationSession.
///
/// It ends by itself: each goal has its time, a goal that is not reached in time or proves
/// unreachable is blacklisted, and a place of finite size has finitely many goals.
class Explorer {
 public:
  Explorer(const RobotParameters& robot, const ExplorerParameters& parameters);
  ~Explorer();
  Explorer(Explorer&&) noexcept;
  Explorer& operator=(Explorer&&) noexcept;

  /// Takes what is observed, and decides.
  Action step(const Observation& observation);

  /// Takes a scan of another laser than the one that the robot drives by: it adds to all that is
  /// known. @param scan  at scan.T_map_sensor. @param T_map_robot  at its time.
  /// @param range_sigma  m, of the scan's ranges.
  void observe(const Scan& scan, const Pose2& T_map_robot, double range_sigma);

  /// Takes a correction of the past, of which the next observation knows already. All that is
  /// remembered of places is made anew or moves along; the robot drives on as it did. Cost: that of
  /// the scans.
  void correct(const PastScans& past);

  /// Somebody else drives to the goals of the actions, see DelegatedDriver. Where the robot's pose
  /// is unknown there is no goal. To be called before the first step.
  void delegateDriving();
  /// What has become of the goal of the last action, where somebody else drives; the next step
  /// takes it into account. One that failed is blacklisted as one that proved unreachable.
  void noteOutcome(DriveOutcome outcome);

  /// Each decision from now on is told to an observer, with what it was made of. It decides
  /// nothing.
  void explainTo(DecisionObserver observer);

  /// The robot moves otherwise from now on: its speeds, accelerations and latency (the rest stays).
  /// What the odometry has shown is learned anew where accelerations or latency change.
  void changeMotion(const RobotParameters& robot);

  /// While paused it observes, and stands still.
  void pause(bool paused) { is_paused_ = paused; }
  /// Gives up exploring and drives back to where it began.
  void returnToStart() { is_returning_ = true; }
  /// Drives to a place of the map and turns to its heading, before all else and though paused; then
  /// all is as it was before. A place that for ten seconds no known path has led to (the robot
  /// stands there no nearer than kBesideGoal), or where the robot has got no farther twice, is
  /// given up. The place moves along where the past is corrected. Not together with
  /// delegateDriving().
  void sendTo(const Pose2& T_map_goal);
  /// Not any more.
  void recall();
  /// Whether it is on the way to where it was sent.
  bool isSent() const;
  static constexpr double kBesideGoal = 0.25;  ///< m: a robot of usual radius covers the place then

  /// Exploration stays inside a polygon (m, map frame). To be called before the first step.
  void limitTo(std::vector<Eigen::Vector2d> polygon);

  /// What the odometry has shown of how the base obeys.
  const ActuationModel& actuation() const;
  const WorldModel& world() const { return *world_; }
  const ExplorationGrid& grid() const;
  const GlobalPlanner& planner() const { return *planner_; }
  /// Whether it has finished although a way that the robot's own radius may admit leads to much
  /// that is in view: a square metre at least, and a twentieth of all that was seen. What no robot
  /// of its size gets to is not missing.
  bool isIncomplete() const;

 private:
  struct Errand;  ///< a place that it was sent to
  struct Intent;  ///< what to do in this step, and why

  void sense(const Observation& seen);
  Intent plan(const Observation& seen);
  Action act(const Intent& intent, const Observation& seen);

  Intent stand(ExplorationStatus status, const std::string& reason, double time);
  Intent explore(const Observation& seen);
  bool waitsForWay(const Plan& plan, double time);
  Intent goHome(const Observation& seen);
  Intent runErrand(const Observation& seen);
  Intent endErrand(ExplorationStatus status, const std::string& reason);
  DriveTask taskTo(int goal, const Pose2& T_map_goal, std::vector<Eigen::Vector2d> path,
                   const Observation& seen) const;

  ExplorerParameters parameters_;
  std::unique_ptr<WorldModel> world_;
  std::unique_ptr<GlobalPlanner> planner_;
  std::unique_ptr<Driver> driver_;
  std::optional<Pose2> T_map_start_;
  bool is_paused_ = false;
  bool is_returning_ = false;
  std::string why_finished_;
  std::unique_ptr<Errand> errand_;
  int errands_ = 0;                         ///< so far
  std::unique_ptr<ProgressClock> shut_in_;  ///< while no way is left to what is
};

}  // namespace cca
