// SPDX-License-Identifier: BSD-3-Clause
//
// What Slam keeps of drives: its own scans, and the key frames of earlier drives.
#include <cassert>

#include "slam/slam_state.hpp"

namespace cca {

void Slam::State::remember(const SlamMemory& memory) {
  assert(!map_.hasDriven(frames_.graph) &&
         memory.scans.size() == static_cast<std::size_t>(memory.graph.size()));
  const int before = frames_.size();
  for (const KeyScan& key : memory.scans) {
    const int frame = frames_.graph.add(memory.graph.pose(frames_.size() - before));
    frames_.surfaces.push_back(scanSurface(key.scan));
    key_scans_.push_back(key);
    corrections_.add(frames_.graph.pose(frame));
    scans_.push_back({frame, {}, key.T_robot_sensor, false});
  }
  for (GraphEdge edge : memory.graph.edges()) {
    edge.from += before;
    edge.to += before;
    frames_.graph.connect(edge);
  }
  map_.remember(frames_.graph);
}

SlamMemory Slam::State::memory() const {
  SlamMemory memory;
  std::vector<int> number(static_cast<std::size_t>(frames_.size()), -1);
  const PoseGraph& graph = frames_.graph;
  for (int k = 0; k < frames_.size(); ++k) {
    if (!map_.holds(graph, k)) continue;
    number[static_cast<std::size_t>(k)] = memory.graph.add(graph.pose(k));
    memory.scans.push_back(key_scans_[static_cast<std::size_t>(k)]);
  }
  for (GraphEdge edge : graph.edges()) {
    edge.from = number[static_cast<std::size_t>(edge.from)];
    edge.to = number[static_cast<std::size_t>(edge.to)];
    if (edge.from >= 0) memory.graph.connect(edge);
  }
  return memory;
}

std::vector<bool> Slam::State::isLocalised() const {
  std::vector<bool> localised;
  for (const DrivenScan& scan : scans_) {
    localised.push_back(!scan.is_doubtful && map_.holds(frames_.graph, scan.frame));
  }
  return localised;
}

std::vector<bool> Slam::State::isSetAside() const {
  std::vector<bool> set_aside;
  for (const DrivenScan& scan : scans_) set_aside.push_back(scan.is_doubtful);
  return set_aside;
}

std::vector<Pose2> Slam::State::trajectory() const {
  std::vector<Pose2> poses;
  for (const DrivenScan& scan : scans_) {
    poses.push_back(frames_.graph.pose(scan.frame) * scan.T_frame_sensor *
                    scan.T_robot_sensor.inverse());
  }
  return poses;
}

}  // namespace cca
