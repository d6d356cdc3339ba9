// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "io/replay/replay.hpp"

namespace cca::apps {

/// What a replay shows of an exploration now. Cost: that of copying the frontier.
inline ReplayMoment momentOf(const Simulation& simulation, const Explorer& explorer,
                             const Observation& believed, const Action& action) {
  ReplayMoment moment;
  moment.time = simulation.time();
  moment.distance = simulation.distance();
  moment.T_map_robot = believed.T_map_robot;
  moment.truth = simulation.T_map_robot();
  moment.goal = action.goal;
  moment.reason = action.reason;
  moment.way = explorer.planner().plan().path;
  for (const Cell& cell : explorer.world().frontierCells().cells()) {
    moment.frontier.push_back(explorer.grid().centreOf(cell));
  }
  return moment;
}

}  // namespace cca::apps
