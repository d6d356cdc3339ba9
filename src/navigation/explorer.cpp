// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

namespace cca {

Explorer::Explorer(const CcaParameters& mapping, const RobotParameters& robot,
                   const ExplorerParameters& parameters)
    : line_map_(mapping), tangent_bug_(robot), parameters_(parameters) {}

Action Explorer::step(const Observation& observation) {
  line_map_.insert(observation.scan);
  grid_.insert(observation.scan);
  Action action;
  action.status = ExplorationStatus::kFinished;
  action.reason = "nothing to explore";
  return action;
}

}  // namespace cca
