// SPDX-License-Identifier: BSD-3-Clause
#include "exploration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "io/files/memory_file.hpp"
#include "known_map/planned_sights.hpp"
#include "live/exploration_moment.hpp"
#include "navigation/planning/global_planner.hpp"

namespace cca {
namespace {

/// The explorer's clock does not count longer gaps between its steps: the robot was held meanwhile,
/// and standing still was no lack of progress.
constexpr double kLongestStep = 0.5;           // s
constexpr double kLongestContradiction = 5.0;  // s
const ros::WallDuration kPagePeriod(0.5);

}  // namespace

Exploration::Exploration(ros::NodeHandle& node, ros::NodeHandle& private_node, Settings settings,
                         const Parameters& program)
    : settings_(std::move(settings)),
      program_(program),
      publisher_(node, settings_.map_frame, program.robot.radius),
      page_(private_node, settings_.page, [this](const RunCommand& command) { heed(command); }),
      mode_(settings_.autostart ? Mode::kRunning : Mode::kStopped),
      saver_(private_node, settings_.out, [this] { return products(); }),
      plan_(node, private_node, settings_.map_frame, settings_.labels, saver_) {
  using Trigger = std_srvs::Trigger;
  using SetBool = std_srvs::SetBool;
  const auto offer = [&](const char* name, Answer (Exploration::*order)()) {
    const auto serve = [this, order](Trigger::Request&, Trigger::Response& response) {
      std::tie(response.success, response.message) = (this->*order)();
      return true;
    };
    services_.push_back(
        private_node.advertiseService<Trigger::Request, Trigger::Response>(name, serve));
  };
  offer("start", &Exploration::start);
  offer("stop", &Exploration::stop);
  offer("home", &Exploration::returnHome);
  const auto serve_pause = [this](SetBool::Request& request, SetBool::Response& response) {
    std::tie(response.success, response.message) = pause(request.data);
    return true;
  };
  services_.push_back(
      private_node.advertiseService<SetBool::Request, SetBool::Response>("pause", serve_pause));
  setMode(mode_);
  page_timer_ = private_node.createWallTimer(kPagePeriod, [this](const ros::WallTimerEvent&) {
    if (session_) page_.repeat(publisher_.status(), session_->mapping().lineMap());
  });
}

void Exploration::begin(std::unique_ptr<Localiser> localiser, const std::string& resume,
                        std::function<void()> on_rebuild) {
  slam_ = dynamic_cast<SlamLocaliser*>(localiser.get());
  recorder_.on_restart = std::move(on_rebuild);
  auto session = std::make_unique<ExplorationSession>(
      std::move(localiser),
      ExplorationSession::Settings{program_.mapping, program_.robot, program_.exploration},
      &recorder_);
  if (slam_ && !resume.empty()) {
    rememberDrive(seenFrom({0.0, 0.0}, loadMemory(resume)), *slam_, session->mapping());
  }
  if (slam_) saver_.saveMemory([this]() -> const Slam& { return slam_->slam(); });
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  session_ = std::move(session);
  session_->explorer().pause(mode_ == Mode::kPaused);
}

void Exploration::lookAtPlan(const Pose2& T_map_robot) {
  const std::vector<Scan> sights =
      plannedSights(*known_plan_, T_map_robot.position(), program_.robot.leastClearance());
  for (const Scan& sight : sights) {
    session_->explorer().observe(sight, sight.T_map_sensor, rangeNoise(sight).range_sigma);
  }
  ROS_INFO("the plan's ways are known, by what is seen from %zu places", sights.size());
  is_plan_seen_ = true;
}

Observation Exploration::sense(const Measurement& measurement, const Velocity& velocity) {
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  if (isIdle() && !session_->mapping().localiser().correctsPast()) return {};
  const Observation observation = session_->sense(measurement, velocity);
  const bool was_corrected = session_->estimate().was_corrected;
  if (was_corrected) publisher_.correctWay(session_->mapping());
  // A correction makes the ways anew from what was seen. The plan stays where it is.
  const bool is_plan_due = known_plan_ && observation.is_localised;
  if (is_plan_due && (was_corrected || !is_plan_seen_)) lookAtPlan(observation.T_map_robot);
  if (slam_) notes_["loops"] = slam_->slam().loopsClosed();
  if (slam_ && slam_->remembered() > 0) notes_["found_in_memory"] = slam_->slam().isInMemory();
  return observation;
}

Scan Exploration::addSecondary(const Measurement& measurement, std::size_t sensor) {
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  if (isIdle()) return measurement.scan;
  session_->addSecondary(measurement, sensor);
  return session_->mapping().scan();
}

Velocity Exploration::step(Observation observation, const ros::Time& stamp) {
  const double passed = std::clamp(observation.time - last_time_, 0.0, kLongestStep);
  own_time_ += passed;
  last_time_ = observation.time;
  T_map_goal_.reset();
  T_map_robot_ = observation.T_map_robot;
  if (isIdle()) {
    if (session_->mapping().localiser().correctsPast()) showPage(observation, {}, stamp);
    return {};
  }
  observation.time = own_time_;
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  const Action action = session_->decide(observation);
  if (action.goal) T_map_goal_ = Pose2{action.goal->x(), action.goal->y(), action.goal_heading};
  publisher_.show(*session_, *recorder_.grid().grid(), observation.T_map_robot, T_map_goal_, stamp);
  const Velocity velocity = act(action, passed, stamp);
  showPage(observation, action, stamp);
  return velocity;
}

/// What there is to do about it beside driving.
Velocity Exploration::act(const Action& action, double passed, const ros::Time& stamp) {
  if (errand_end_) {
    followErrand(action, passed);
    return errand_end_ ? action.velocity : Velocity{};
  }
  if (session_->mapping().localiser().correctsPast() &&
      action.status == ExplorationStatus::kFinished) {
    end_ = action;
    return {};
  }
  // The whole first: who hears "finished" finds the last map and way.
  if (action.status == ExplorationStatus::kFinished) finish(stamp);
  failed_ = isContradicted(passed);
  if (failed_ && !finished_) finish(stamp);
  tell(action);
  return finished_ ? Velocity{} : action.velocity;
}

void Exploration::showPage(const Observation& observation, Action action, const ros::Time& stamp) {
  if (!page_.isDue()) return;
  page_.setPaused(!drives());
  if (!drives()) action.reason = publisher_.status();
  page_.show(momentOf(session_->explorer(), observation.T_map_robot, action), observation.scan,
             session_->mapping().lineMap(), stamp);
}

void Exploration::followErrand(const Action& action, double passed) {
  if (action.status == ExplorationStatus::kArrived)
    return endErrand(ErrandOutcome::kReached, "the goal is reached");
  if (action.status == ExplorationStatus::kUnreachable)
    return endErrand(ErrandOutcome::kUnreachable, "the goal is unreachable: " + action.reason);
  if (isContradicted(passed))
    return endErrand(ErrandOutcome::kCalledOff, "scans contradict the map");
  tell(action);
}

void Exploration::endErrand(ErrandOutcome outcome, const std::string& how) {
  session_->explorer().recall();
  why_paused_ = how + "; call ~pause with false to go on";
  setState(finished_ ? "finished: " + how : "paused: " + why_paused_);
  const ErrandEnd end = std::exchange(errand_end_, nullptr);
  page_.setPaused(!drives());
  end(outcome, how);
}

void Exploration::sendTo(const Pose2& T_map_goal, ErrandEnd end) {
  recall("another goal was set");
  if (!session_) return end(ErrandOutcome::kCalledOff, "it is not known yet where the robot is");
  setMode(Mode::kPaused);
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  session_->explorer().sendTo(T_map_goal);
  errand_end_ = std::move(end);
  page_.setPaused(false);
  setState("driving: to where it was sent");
}

void Exploration::recall(const std::string& why) {
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  if (errand_end_) endErrand(ErrandOutcome::kCalledOff, why);
}

void Exploration::conclude(const ros::Time& stamp) {
  finishPoses();
  const Action action = *std::exchange(end_, std::nullopt);
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  finish(stamp);
  failed_ = isContradicted(0.0);
  tell(action);
}

void Exploration::finishPoses() {
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  if (!hasBegun() || !session_->mapping().localiser().correctsPast()) return;
  session_->finish();
  if (slam_) notes_["loops"] = slam_->slam().loopsClosed();
  publisher_.correctWay(session_->mapping());
}

void Exploration::note(const std::string& key, const nlohmann::json& value) {
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  notes_[key] = value;
}

bool Exploration::isContradicted(double seconds) {
  const bool is_poor = agreement().recent() < kPoorAgreement;
  contradicted_for_ = is_poor ? contradicted_for_ + seconds : 0.0;
  return contradicted_for_ > kLongestContradiction ||
         (finished_ && agreement().overall() < kPoorAgreement);
}

void Exploration::tell(const Action& action) {
  const bool at_odds = contradicted_for_ > 0.0;
  if (at_odds) {
    ROS_WARN_THROTTLE(5.0, "scans contradict the map: %.1f %% of their returns agree with it",
                      100.0 * agreement().recent());
  }
  const bool is_paused = action.status == ExplorationStatus::kPaused;
  const std::string& reason = is_paused ? why_paused_ : action.reason;
  setState(failed_ ? "failed: scans contradict the map; the pose is lost, or the scans are wrong"
                   : std::string(nameOf(action.status)) + ": " + reason +
                         (at_odds ? "; scans contradict the map" : ""));
}

void Exploration::finish(const ros::Time& stamp) {
  // Where the past is corrected, finishPoses() has done so.
  if (!session_->mapping().localiser().correctsPast()) session_->finish();
  finished_ = true;
  publisher_.showAll(*session_, *recorder_.grid().grid(), stamp);
  const Explorer& explorer = session_->explorer();
  if (explorer.planner().plan().gave_up) ROS_WARN("%s", explorer.planner().plan().reason.c_str());
  if (explorer.isIncomplete()) {
    ROS_WARN("%.1f m^2 in view were not reached, though the robot may fit through to them",
             explorer.planner().plan().passableArea());
  }
  if (settings_.save_at_end) saver_.saveSoon();
}

MapProducts Exploration::products() const {
  if (!hasBegun()) throw std::runtime_error("there is no map yet");
  MapProducts products = mapProducts(settings_.page.title, session_->mapping());
  products.grid = recorder_.grid().raster();
  products.summary["finished"] = finished_ && !failed_;
  products.summary["agreement"] = agreement().overall();
  products.summary["reason"] = state_;
  products.summary["unreached_m2"] = session_->explorer().planner().plan().unreachedArea();
  products.summary.update(notes_);
  return products;
}

void Exploration::end() {
  if (session_) page_.finish(session_->mapping().lineMap().lines(), publisher_.status());
  if (settings_.save_at_end && hasBegun()) saver_.saveOrTell();
}

void Exploration::setState(const std::string& state) {
  state_ = state;
  publisher_.showStatus(state_);
}

void Exploration::setMode(Mode mode) {
  recall("called off");
  const std::lock_guard<std::mutex> lock(saver_.mutex());
  mode_ = mode;
  if (session_) session_->explorer().pause(mode == Mode::kPaused);
  why_paused_ = "call ~pause with false to go on";
  page_.setPaused(!drives());
  if (finished_) return;
  setState(mode == Mode::kStopped  ? "stopped: call ~start to explore"
           : mode == Mode::kPaused ? "paused: " + why_paused_
                                   : "waiting: for the first scan");
}

void Exploration::pause(const std::string& why) {
  setMode(Mode::kPaused);
  if (finished_) return;
  why_paused_ = why + "; " + why_paused_;
  setState("paused: " + why_paused_);
}

Exploration::Answer Exploration::start() {
  if (failed_) finished_ = failed_ = false;  // somebody has found the robot, or its laser's fault
  contradicted_for_ = 0.0;
  if (finished_) return {false, "the exploration has finished"};
  setMode(Mode::kRunning);
  return {true, "exploring"};
}

Exploration::Answer Exploration::stop() {
  setMode(Mode::kStopped);
  return {true, "stopped"};
}

Exploration::Answer Exploration::pause(bool is_wanted) {
  if (isIdle()) return {false, "not exploring"};
  setMode(is_wanted ? Mode::kPaused : Mode::kRunning);
  return {true, is_wanted ? "paused" : "exploring"};
}

Exploration::Answer Exploration::returnHome() {
  if (!hasBegun()) return {false, "it has not left yet"};
  {
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    session_->explorer().returnToStart();
    finished_ = failed_ = false;
    contradicted_for_ = 0.0;
  }
  setMode(Mode::kRunning);
  return {true, "returning"};
}

void Exploration::heed(const RunCommand& command) {
  using Kind = RunCommand::Kind;
  if (command.kind == Kind::kGo && is_delegated_) {
    ROS_WARN("the page's command: move_base takes its goals itself");
    return;
  }
  if (command.kind == Kind::kGo) {
    const Eigen::Vector2d way = command.place_map - T_map_robot_.position();
    return sendTo({command.place_map.x(), command.place_map.y(), std::atan2(way.y(), way.x())},
                  [](ErrandOutcome, const std::string& how) { ROS_INFO("%s", how.c_str()); });
  }
  const auto [success, message] = command.kind == Kind::kStart   ? start()
                                  : command.kind == Kind::kPause ? pause(true)
                                  : command.kind == Kind::kHome  ? returnHome()
                                                                 : stop();
  if (!success) ROS_WARN("the page's command: %s", message.c_str());
}

}  // namespace cca
