// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "background_work.hpp"
#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/session/exploration_session.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "decision_file.hpp"
#include "exploration_record.hpp"
#include "interruption.hpp"
#include "io/files/memory_file.hpp"
#include "live/live_page.hpp"
#include "progress.hpp"

namespace cca::apps {

/// "91.3 % seen, ", or nothing where it is not known.
std::string seenText(const std::optional<double>& seen);

/// A simulated exploration: the robot of a simulation, driven by an exploration session, and all
/// that is recorded of it. Mapping and recording go on beside the drive, on another core; the
/// result does not depend on which is faster.
class ExplorationRun {
 public:
  /// @param origin  m, map frame: where the simulation's frame lies.
  /// @param folder  for the files of the run.
  ExplorationRun(Simulation& simulation, const Eigen::Vector2d& origin,
                 const Parameters& parameters, const std::string& folder);

  /// Goes on with an earlier map, from anywhere in it; to be called first, with line SLAM only.
  void remember(const SlamMemory& memory);

  /// Shows the run to somebody; to be called before drive(). It must outlive the run.
  void addObserver(RunObserver& observer) { observers_.push_back(&observer); }
  /// The same, and does what viewers of the page want.
  void obey(LivePage& page);
  /// Each decision is added to a file, which lives as long as this.
  void explainTo(DecisionFile& file);

  /// Explores until nothing is left, the time is over, the robot is lost, or the user interrupts.
  /// @param progress  may be null.
  void drive(const Interruption& interruption, Progress* progress);

  /// The last pass over poses and map.
  void finish();

  /// Whether the earlier map was found, or there is none.
  bool isInMemory() const { return !slam_ || slam_->slam().isInMemory(); }
  /// What a run that ended by itself has not done well; empty where there is nothing.
  std::string shortcomings() const;

  ExplorationRecord& record() { return record_; }
  ExplorationRecord::End& end() { return end_; }
  const ExplorationSession& session() const { return session_; }
  const SlamLocaliser* slam() const { return slam_; }

 private:
  using Clock = std::chrono::steady_clock;
  Observation asOfNow(Observation observation) const;
  Action step();
  void mapBeside(std::function<void()> work);
  bool hasEnded(const Action& action);
  void show(const Action& action, Progress* progress);
  void showObservers(const Action& action);
  void heedCommands();
  void heed(const RunCommand& command);
  void standStill(const Action& action, const Interruption& interruption);
  std::string progressText(const Action& action, double metres_left);

  Simulation& simulation_;
  MissingReturns missing_returns_;
  Parameters parameters_;
  ExplorationRecord record_;
  SlamLocaliser* slam_ = nullptr;  ///< the session's, where the poses are line SLAM's
  ExplorationSession session_;
  Observation observation_;           ///< the last one, as believed
  std::optional<Pose2> last_moment_;  ///< of the replay
  double seen_at_ = 0.0;              ///< s, simulated: the last scan that told anything
  double localised_at_ = 0.0;         ///< m of way: where the robot last knew its pose
  std::vector<RunObserver*> observers_;
  LivePage* page_ = nullptr;  ///< one of them, whose viewers' commands are done
  bool is_paused_ = false;    ///< by them
  ExplorationRecord::End end_;
  Clock::time_point begin_ = Clock::now();
  BackgroundWork background_;  // last: what it still does needs all the rest
};

}  // namespace cca::apps
