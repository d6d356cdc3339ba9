// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "cca_mrpt/navigation/exploration_grid.hpp"
#include "cca_mrpt/navigation/global_planner.hpp"
#include "cca_mrpt/navigation/past_scans.hpp"
#include "cca_mrpt/navigation/robot.hpp"
#include "cca_mrpt/navigation/tangent_bug.hpp"
#include "cca_mrpt/navigation/way_progress.hpp"

namespace cca {

/// What the robot knows at one moment.
struct Observation {
  Scan scan;  ///< taken at scan.T_map_sensor
  Pose2 T_map_robot;
  Velocity velocity;  ///< as measured
  double time = 0.0;  ///< s, never falling
};

enum class ExplorationStatus { kExploring, kReturning, kPaused, kFinished };

/// What the robot shall do next.
struct Action {
  Velocity velocity;
  std::optional<Eigen::Vector2d> goal;  ///< m, map frame
  ExplorationStatus status = ExplorationStatus::kExploring;
  std::string reason;  ///< one sentence for people: why it drives there, or why it has finished
};

struct ExplorerParameters {
  std::string strategy = "view_tour";
  std::string path = "known_space";
  double worth = 80.0;
  double smallest_gain = 0.1;
  bool return_to_start = false;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(ExplorerParameters& p, Field&& field) {
  field("strategy", p.strategy,
        {"view_tour", "greedy", "nearest_frontier", "gain_distance", "information"},
        "how the next goal is chosen; greedy is the paper's");
  field("path", p.path, {"known_space", "paper"},
        "way-points along what is known to be free, or (paper) Tangent Bug straight to the goal");
  field("worth", p.worth, 0.0, 1e6, "m/m^2",
        "way that an unseen square metre is worth: exploration ends when nothing that is "
        "left is worth its way");
  field("smallest_gain", p.smallest_gain, 0.0, 100.0, "m^2",
        "exploration ends when no reachable frontier promises more");
  field("return_to_start", p.return_to_start, "drive back to where it began when all is explored");
}

/// The one door into mapping and navigation: the simulator's loop and the ROS callback both walk
/// through it. Scan -> line map; scan -> exploration grid -> goal -> Tangent Bug -> velocity.
///
/// It ends by itself: each goal has its time, a goal that is not reached in time or proves
/// unreachable is set aside, and a place of finite size has finitely many goals.
class Explorer {
 public:
  /// @throws std::runtime_error for an unknown strategy or path.
  Explorer(const CcaParameters& mapping, const RobotParameters& robot,
           const ExplorerParameters& parameters);

  /// Maps and navigates: all that is to be done with an observation.
  Action step(const Observation& observation);

  /// The two halves of step(). They share nothing: a caller with two cores may run them side by
  /// side, as long as every scan is mapped, in order, before lineMap() is looked at.
  void map(const Scan& scan);
  Action navigate(const Observation& observation);

  /// Take a correction of the past, of which the next observation knows already: the two halves of
  /// it, as above. The map and all that is remembered of places is made anew or moves along; the
  /// robot drives on as it did. Cost: that of the scans.
  void correctMap(const PastScans& past);
  void correctNavigation(const PastScans& past);

  /// While paused it maps, and stands still.
  void pause(bool paused) { is_paused_ = paused; }
  /// Gives up exploring and drives back to where it began.
  void returnToStart() { is_returning_ = true; }
  /// Exploration stays inside a polygon (m, map frame). To be called before the first step.
  void limitTo(std::vector<Eigen::Vector2d> polygon) { planner_.limitTo(std::move(polygon)); }
  /// Cells known from a saved map. To be called before the first step.
  void seed(const std::vector<Cell>& cells, CellState state) { planner_.seed(cells, state); }

  const LineMap& lineMap() const { return line_map_; }
  /// How far the scans agree with the line map that the earlier ones made.
  const ScanAgreement& agreement() const { return agreement_; }
  const ExplorationGrid& grid() const { return planner_.grid(); }
  const GlobalPlanner& planner() const { return planner_; }

 private:
  Action explore(const Observation& observation);
  Action lookAround(const Observation& observation);
  Action goHome(const Observation& observation);
  Velocity driveTo(const Eigen::Vector2d& way_point_map, const Observation& observation);
  bool isStuck(double time);

  ExplorerParameters parameters_;
  RobotParameters robot_;
  CcaParameters mapping_;
  LineMap line_map_;
  ScanAgreement agreement_;
  GlobalPlanner planner_;
  /// The frame that the local planner drives in: where the map is corrected, the robot goes on
  /// smoothly in it.
  Pose2 T_drive_map_;
  TangentBug tangent_bug_;  ///< in the drive frame
  WayProgress progress_;
  std::optional<Eigen::Vector2d> start_map_;
  std::optional<Eigen::Vector2d> way_point_;  ///< drive frame
  std::optional<double> looks_around_since_;  ///< s
  bool is_paused_ = false;
  bool is_returning_ = false;
  std::string why_finished_;
};

}  // namespace cca
