// SPDX-License-Identifier: BSD-3-Clause
#include "exploration_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "apps/logs/contradiction.hpp"
#include "apps/options/moved.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "io/files/text.hpp"
#include "io/poses/pose_source.hpp"
#include "live/exploration_moment.hpp"
#include "navigation/planning/global_planner.hpp"
#include "navigation/world/world_model.hpp"
#include "on_all_cores.hpp"
#include "tour_left.hpp"

namespace cca::apps {
namespace {

/// m of way; a robot that has not found its place for so long is not exploring any more.
constexpr double kLongestLost = 30.0;

/// s; a robot whose laser tells nothing stands, and in a simulation nobody comes to uncover it.
constexpr double kLongestBlind = 60.0;

bool isBlind(const Scan& scan) {
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.freeRange(beam) > 0.0) return false;
  }
  return true;
}

double microsecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
      .count();
}

/// A laser whose scans are of one instant is known to have such.
ExplorationSession::Settings settingsOf(const Parameters& parameters,
                                        const LaserParameters& laser) {
  return {parameters.mapping, parameters.robot, parameters.exploration,
          laser.sweep == 0.0 ? std::optional<double>(0.0) : std::nullopt};
}

/// What a replay shows of the exploration now. Cost: that of copying the frontier.
ReplayMoment momentOf(const Simulation& simulation, const Explorer& explorer,
                      const Observation& believed, const Action& action) {
  ReplayMoment moment = cca::momentOf(explorer, believed.T_map_robot, action);
  moment.time = simulation.time();
  moment.distance = simulation.distance();
  moment.truth = simulation.T_map_robot();
  return moment;
}

/// How far the robot still has to go, as far as it knows: to each frontier.
double metresLeft(const Simulation& simulation, const Explorer& explorer) {
  std::vector<Eigen::Vector2d> frontier;
  for (const Cell& cell : explorer.world().frontierCells().cells()) {
    frontier.push_back(explorer.grid().centreOf(cell));
  }
  return tourLeft(simulation.T_map_robot().position(), frontier);
}

}  // namespace

std::string seenText(const std::optional<double>& seen) {
  return seen ? formatted("%.1f %% seen, ", 100.0 * *seen) : "";
}

ExplorationRun::ExplorationRun(Simulation& simulation, const Eigen::Vector2d& origin,
                               const Parameters& parameters, const std::string& folder)
    : simulation_(simulation),
      parameters_(parameters),
      record_(simulation, origin, parameters, folder),
      session_(makeLocaliser(poseSource(parameters.run.pose), parameters.icp),
               settingsOf(parameters, simulation.parameters().laser), &record_,
               [this](std::function<void()> work) { mapBeside(std::move(work)); }) {
  slam_ = dynamic_cast<SlamLocaliser*>(&session_.mapping().localiser());
}

void ExplorationRun::remember(const SlamMemory& memory) {
  rememberDrive(memory, *slam_, session_.mapping());
}

void ExplorationRun::explainTo(DecisionFile& file) {
  session_.explorer().explainTo([this, &file](const ExplainedDecision& decision) {
    file.add(decision, simulation_.time(), simulation_.distance());
  });
}

void ExplorationRun::mapBeside(std::function<void()> work) {
  background_.add([this, work = std::move(work)] {
    const Clock::time_point start = Clock::now();
    work();
    record_.addMappingTime(microsecondsSince(start));
  });
}

/// A scan tells where the robot was in the middle of its sweep; the wheels, how it has gone on.
Observation ExplorationRun::asOfNow(Observation observation) const {
  const Instant& scanned = simulation_.scanned();
  if (scanned.time == simulation_.time()) return observation;
  observation.T_map_robot =
      observation.T_map_robot * (scanned.T_odom_robot.inverse() * simulation_.T_odom_robot());
  observation.time = simulation_.time();
  return observation;
}

Action ExplorationRun::step() {
  Observation seen = simulation_.observe();
  const Clock::time_point start = Clock::now();
  if (simulation_.parameters().laser.missing != MissingReading::kTold) {
    missing_returns_.judge(seen.scan);
  }
  if (!isBlind(seen.scan)) seen_at_ = simulation_.time();
  const Instant& scanned = simulation_.scanned();
  observation_ = session_.sense(
      measurementOf(seen, scanned.T_odom_robot, simulation_.sweepMotion()), seen.velocity);
  const Action action = session_.decide(asOfNow(observation_));
  ExplorationRecord::Cycle cycle{
      scanned.time, simulation_.distance(), scanned.T_map_robot, scanned.T_odom_robot,
      observation_, std::move(seen.scan),   action.goal,         microsecondsSince(start)};
  std::optional<ReplayMoment> moment;
  if (keepIfMoved(last_moment_, observation_.T_map_robot) ||
      action.status == ExplorationStatus::kFinished) {
    moment = momentOf(simulation_, session_.explorer(), observation_, action);
  }
  background_.add([this, cycle = std::move(cycle), moment = std::move(moment)] {
    record_.add(cycle);
    if (!moment) return;
    record_.replay().add(*moment, cycle.believed.scan, session_.mapping().lineMap());
  });
  if (observation_.is_localised) localised_at_ = simulation_.distance();
  return action;
}

bool ExplorationRun::hasEnded(const Action& action) {
  if (simulation_.distance() - localised_at_ > kLongestLost) {
    end_.reason = "the robot has not known its place for " +
                  std::to_string(static_cast<int>(kLongestLost)) + " m";
    return true;
  }
  if (simulation_.time() - seen_at_ > kLongestBlind) {
    end_.reason = "the laser's beams have told nothing for " +
                  std::to_string(static_cast<int>(kLongestBlind)) +
                  " s: none comes back from within its range";
    return true;
  }
  if (action.status != ExplorationStatus::kFinished) return false;
  const Plan& plan = session_.explorer().planner().plan();
  end_ = {true, action.reason, 0.0, plan, session_.explorer().isIncomplete()};
  return true;
}

void ExplorationRun::drive(const Interruption& interruption, Progress* progress) {
  end_.reason = "the longest simulated time is over";
  while (simulation_.time() < parameters_.run.longest_time) {
    if (interruption.requested()) {
      end_.reason = "interrupted";
      break;
    }
    heedCommands();
    const Action action = step();
    if (hasEnded(action)) break;
    showObservers(action);
    simulation_.drive(action.velocity, parameters_.run.control_period);
    show(action, progress);
    if (action.status == ExplorationStatus::kPaused) standStill(action, interruption);
  }
  background_.wait();
}

void ExplorationRun::obey(LivePage& page) {
  addObserver(page);
  page_ = &page;
}

void ExplorationRun::heedCommands() {
  while (page_) {
    const std::optional<RunCommand> command = page_->nextCommand();
    if (!command) return;
    heed(*command);
    page_->setPaused(is_paused_);
  }
}

void ExplorationRun::heed(const RunCommand& command) {
  using Kind = RunCommand::Kind;
  Explorer& explorer = session_.explorer();
  const Eigen::Vector2d way = command.place_map - observation_.T_map_robot.position();
  if (command.kind == Kind::kGo) {
    explorer.sendTo(
        Pose2{command.place_map.x(), command.place_map.y(), std::atan2(way.y(), way.x())});
    return;
  }
  if (command.kind == Kind::kStop || command.kind == Kind::kHome) explorer.recall();
  if (command.kind == Kind::kHome) explorer.returnToStart();
  is_paused_ = command.kind == Kind::kPause || command.kind == Kind::kStop;
  explorer.pause(is_paused_);
}

/// While the robot stands because somebody wants it, no simulated time goes by either. Where it
/// stands is shown.
void ExplorationRun::standStill(const Action& action, const Interruption& interruption) {
  constexpr double kStanding = 0.01;  // m/s, rad/s: it brakes first
  const Velocity velocity = observation_.velocity;
  if (std::abs(velocity.linear) > kStanding || std::abs(velocity.angular) > kStanding) return;
  const auto is_wanted = [this] {
    heedCommands();
    return is_paused_ && !session_.explorer().isSent();
  };
  while (is_wanted() && !interruption.requested()) {
    showObservers(action);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void ExplorationRun::showObservers(const Action& action) {
  const auto is_due = [](const RunObserver* observer) { return observer->isDue(); };
  if (std::none_of(observers_.begin(), observers_.end(), is_due)) return;
  background_.wait();
  const ReplayMoment moment = momentOf(simulation_, session_.explorer(), observation_, action);
  const RunView view{moment, observation_.scan, session_.mapping().lineMap(), simulation_.bodies(),
                     [this] { return record_.products(simulation_, session_.mapping()); }};
  for (RunObserver* observer : observers_) {
    if (observer->isDue()) observer->show(view);
  }
}

void ExplorationRun::show(const Action& action, Progress* progress) {
  if (!progress || !progress->isDue()) return;
  background_.wait();
  const double left = metresLeft(simulation_, session_.explorer()), driven = simulation_.distance();
  progress->show(driven + left > 0.0 ? driven / (driven + left) : 0.0, progressText(action, left));
}

std::string ExplorationRun::progressText(const Action& action, double metres_left) {
  std::string goal = "none";
  if (action.goal) {
    const Eigen::Vector2d p_map = record_.origin() + *action.goal;
    goal = formatted("%.1f, %.1f", p_map.x(), p_map.y());
  }
  const double seconds = std::max(1e-6 * microsecondsSince(begin_), 1e-3);
  return formatted("%s%.0f m driven, %.0f m to go, %.0f s simulated, goal %s, %.0f scans/s",
                   seenText(record_.coverage().sofar()).c_str(), simulation_.distance(),
                   metres_left, simulation_.time(), goal.c_str(),
                   static_cast<double>(record_.scans()) / seconds);
}

void ExplorationRun::finish() {
  session_.finish(doOnAllCores);
  background_.wait();
}

std::string ExplorationRun::shortcomings() const {
  std::string text;
  const auto tell = [&text](const std::string& what) {
    text += (text.empty() || what.empty() ? "" : ", ") + what;
  };
  if (simulation_.collisions() > 0) {
    tell(std::to_string(simulation_.collisions()) + " contacts with what stands");
  }
  if (end_.plan.gave_up) tell(end_.reason);
  if (end_.is_incomplete) {
    tell(formatted("%.1f m^2 in view that the robot may fit through to", end_.plan.passableArea()));
  }
  tell(contradiction(session_.mapping().agreement()));
  return text;
}

}  // namespace cca::apps
