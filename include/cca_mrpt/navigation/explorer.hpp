// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan.hpp"
#include "cca_mrpt/navigation/exploration_grid.hpp"
#include "cca_mrpt/navigation/global_planner.hpp"
#include "cca_mrpt/navigation/robot.hpp"
#include "cca_mrpt/navigation/tangent_bug.hpp"

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
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(ExplorerParameters& p, Field&& field) {
  field("strategy", p.strategy, {"view_tour", "greedy", "nearest_frontier", "gain_distance"},
        "how the next goal is chosen");
}

/// The one door into mapping and navigation: the simulator's loop and the ROS callback both walk
/// through it. Scan -> line map; scan -> exploration grid -> goal -> Tangent Bug -> velocity.
class Explorer {
 public:
  Explorer(const CcaParameters& mapping, const RobotParameters& robot,
           const ExplorerParameters& parameters);

  Action step(const Observation& observation);

  const LineMap& lineMap() const { return line_map_; }
  const ExplorationGrid& grid() const { return planner_.grid(); }
  const GlobalPlanner& planner() const { return planner_; }
  const TangentBug& tangentBug() const { return tangent_bug_; }

 private:
  Velocity follow(const Plan& plan, const Observation& observation);

  LineMap line_map_;
  GlobalPlanner planner_;
  TangentBug tangent_bug_;
  std::optional<Eigen::Vector2d> way_point_;
};

}  // namespace cca
