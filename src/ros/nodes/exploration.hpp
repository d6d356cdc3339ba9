// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/session/exploration_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "io/maps/grid_recorder.hpp"
#include "known_map/plan_lines.hpp"
#include "ros/output/exploration_publisher.hpp"
#include "ros/output/map_saver.hpp"
#include "ros/output/plan_server.hpp"
#include "ros/output/run_page.hpp"

namespace cca {

/// An exploration session with what a person does to it: the services `~start`, `~stop`, `~pause`,
/// `~home`, `~save`, the topics of ExplorationPublisher, and the live page, whose buttons do as the
/// services do. Where its observations come from, and where its velocities go, is its owner's
/// business.
class Exploration {
 public:
  struct Settings {
    std::string map_frame = "map";
    std::string labels;           ///< CSV with names of rooms; empty: none
    std::string out = "cca_map";  ///< folder for ~save, relative to where the node runs
    bool autostart = true;
    bool save_at_end = true;
    RunPage::Settings page;  ///< its title is the map's, too
  };

  Exploration(ros::NodeHandle& node, ros::NodeHandle& private_node, Settings settings,
              const Parameters& program);

  /// To be called before all that follows. @param resume  folder of an earlier map, or its
  /// map.slam, that line SLAM is to go on with; empty: none.
  /// @param on_rebuild  called before the map is made anew, which takes a second where it is large.
  /// @throws std::runtime_error naming the file of the earlier map and what is wrong with it.
  void begin(std::unique_ptr<Localiser> localiser, const std::string& resume = "",
             std::function<void()> on_rebuild = {});

  /// A plan of the place, in the map's frame: the robot knows the ways of it that lead on from
  /// where it is localised first, as if it had seen them. What it sees itself counts in their
  /// place.
  void knowPlan(const std::vector<PlanLine>& plan) { known_plan_.emplace(plan); }

  /// Localises and maps a scan. Where poses are given, a scan while it is stopped or has finished
  /// is not mapped. @return  for step().
  Observation sense(const Measurement& measurement, const Velocity& velocity);
  /// A scan of another laser than that of the steps; see MappingSession::addSecondary().
  /// @return  it, of one instant; as it came where nothing is mapped.
  Scan addSecondary(const Measurement& measurement, std::size_t sensor);
  /// One step of the explorer. @return  zero unless it explores.
  /// observation.time may do what it likes: the explorer's own clock stands while it waits.
  Velocity step(Observation observation, const ros::Time& stamp);

  /// See Explorer::delegateDriving(), noteOutcome().
  void delegateDriving() {
    session_->explorer().delegateDriving();
    is_delegated_ = true;
  }
  void noteOutcome(DriveOutcome outcome) { session_->explorer().noteOutcome(outcome); }
  /// Where the last step wants the robot, and where to it shall look there: only while it drives.
  const std::optional<Pose2>& goal() const { return T_map_goal_; }
  void changeMotion(const RobotParameters& robot) { session_->explorer().changeMotion(robot); }
  /// As `~pause` with true does. @param why  part of the status.
  void pause(const std::string& why);

  /// What became of a place that the robot was sent to.
  enum class ErrandOutcome { kReached, kUnreachable, kCalledOff };
  using ErrandEnd = std::function<void(ErrandOutcome outcome, const std::string& how)>;
  /// Leaves off exploring and drives to a place of the map; there it stays paused, or finished. A
  /// place that it was sent to before, or the services above, call it off, which is told to `end`,
  /// too.
  void sendTo(const Pose2& T_map_goal, ErrandEnd end);
  void recall(const std::string& why);
  /// At the last step.
  const Pose2& pose() const { return T_map_robot_; }

  /// Where the localiser corrects the past, the exploration waits for conclude() once nothing is
  /// left: there is a last pass over the poses, for which the robot has to stand.
  bool isAtEnd() const { return end_.has_value(); }
  void conclude(const ros::Time& stamp);
  /// The last pass, for a robot that is stopped before.
  void finishPoses();

  /// A line of summary.json.
  void note(const std::string& key, const nlohmann::json& value);

  /// Neither paused, stopped nor finished; or sent somewhere.
  bool drives() const { return (mode_ == Mode::kRunning && !finished_) || errand_end_; }
  /// Also where it failed.
  bool finished() const { return finished_; }
  const ExplorationSession& session() const { return *session_; }
  const ScanAgreement& agreement() const { return session_->mapping().agreement(); }
  const ActuationModel& actuation() const { return session_->explorer().actuation(); }
  /// Told as the status while the robot has to stand: why.
  void wait(const std::string& reason) { publisher_.showStatus("waiting: " + reason); }
  const std::string& state() const { return state_; }

  /// What Ctrl-C leaves behind: the map, where that is wanted and there is one.
  void end();

 private:
  enum class Mode { kStopped, kRunning, kPaused };

  /// What became of something that a person wanted: whether it is done, and a message.
  using Answer = std::pair<bool, std::string>;
  Answer start();
  Answer stop();
  Answer pause(bool is_wanted);
  Answer returnHome();
  void heed(const RunCommand& command);
  void setMode(Mode mode);
  void setState(const std::string& state);
  Velocity act(const Action& action, double passed, const ros::Time& stamp);
  void showPage(const Observation& observation, Action action, const ros::Time& stamp);
  void lookAtPlan(const Pose2& T_map_robot);
  void finish(const ros::Time& stamp);
  MapProducts products() const;
  void tell(const Action& action);
  void followErrand(const Action& action, double passed);
  void endErrand(ErrandOutcome outcome, const std::string& how);
  bool isContradicted(double seconds);
  bool isIdle() const { return !errand_end_ && (mode_ == Mode::kStopped || finished_); }
  bool hasBegun() const { return session_ && !session_->mapping().times().empty(); }

  /// The grid, and who is to know that the map is made anew.
  class Recorder : public GridRecorder {
   public:
    std::function<void()> on_restart;
    void restart() override {
      if (on_restart) on_restart();
      GridRecorder::restart();
    }
  };

  Settings settings_;
  Parameters program_;
  Recorder recorder_;
  SlamLocaliser* slam_ = nullptr;  ///< the session's, with line SLAM
  std::unique_ptr<ExplorationSession> session_;
  ExplorationPublisher publisher_;
  RunPage page_;
  ros::WallTimer page_timer_;  ///< of a robot that waits, viewers are told why
  std::optional<PlanLines> known_plan_;
  bool is_plan_seen_ = false;
  Mode mode_;
  bool finished_ = false, failed_ = false, is_delegated_ = false;
  std::optional<Action> end_;                ///< that waits for conclude()
  double own_time_ = 0.0, last_time_ = 0.0;  // s
  double contradicted_for_ = 0.0;            // s, that scans and map have been at odds
  std::string state_, why_paused_;
  std::optional<Pose2> T_map_goal_;
  Pose2 T_map_robot_;
  ErrandEnd errand_end_;  ///< empty: it was sent nowhere
  nlohmann::ordered_json notes_ = nlohmann::ordered_json::object();
  std::vector<ros::ServiceServer> services_;
  // Last: they may still be at work, by products(), when all this ends.
  MapSaver saver_;
  PlanServer plan_;
};

}  // namespace cca
