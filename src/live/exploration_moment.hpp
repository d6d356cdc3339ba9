// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/navigation/explorer.hpp"
#include "io/replay/replay.hpp"
#include "navigation/planning/global_planner.hpp"
#include "navigation/world/world_model.hpp"

namespace cca {

/// What a page shows of an exploration now, but when that is and how far the robot has driven.
/// Cost: that of copying the frontier.
inline ReplayMoment momentOf(const Explorer& explorer, const Pose2& T_map_robot,
                             const Action& action) {
  ReplayMoment moment;
  moment.T_map_robot = T_map_robot;
  moment.goal = action.goal;
  moment.reason = action.reason;
  moment.way = explorer.planner().plan().path;
  for (const Cell& cell : explorer.world().frontierCells().cells()) {
    moment.frontier.push_back(explorer.grid().centreOf(cell));
  }
  return moment;
}

}  // namespace cca
