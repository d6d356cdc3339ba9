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

std::optional<std::size_t> joinDrives(const std::vector<const SlamMemory*>& drives,
                                      SlamLocaliser& slam, MappingSession& session,
                                      const DoAll& do_all) {
  std::vector<std::size_t> first_of;  // scan of each drive
  for (const SlamMemory* drive : drives) {
    first_of.push_back(slam.remembered());
    rememberDrive(*drive, slam, session);
  }
  session.finish(do_all);
  const std::vector<bool> is_localised = slam.isLocalised();
  for (std::size_t k = 1; k < drives.size(); ++k) {
    if (!is_localised[first_of[k]]) return k;
  }
  return std::nullopt;
}

}  // namespace cca
