// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/simulation/simulation.hpp"
#include "live/exploration_moment.hpp"

namespace cca::apps {

/// What a replay shows of a simulated exploration now. Cost: that of copying the frontier.
inline ReplayMoment momentOf(const Simulation& simulation, const Explorer& explorer,
                             const Observation& believed, const Action& action) {
  ReplayMoment moment = cca::momentOf(explorer, believed.T_map_robot, action);
  moment.time = simulation.time();
  moment.distance = simulation.distance();
  moment.truth = simulation.T_map_robot();
  return moment;
}

}  // namespace cca::apps
