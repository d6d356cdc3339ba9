// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/earlier_drive.hpp"

namespace cca {

void rememberDrive(const SlamMemory& memory, SlamLocaliser& slam, MappingSession& session) {
  slam.remember(memory);
  for (int k = 0; k < memory.graph.size(); ++k) {
    const KeyScan& key = memory.scans[static_cast<std::size_t>(k)];
    const Pose2& T_map_sensor = memory.graph.pose(k);
    session.remember(key.scan, T_map_sensor * key.T_robot_sensor.inverse(), T_map_sensor);
  }
}

}  // namespace cca
