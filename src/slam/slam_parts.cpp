// SPDX-License-Identifier: BSD-3-Clause
//
// Slam's parts of the graph: drives whose place in the map is known, lost or remembered.
#include <algorithm>
#include <cassert>
#include <limits>

#include "cca_mrpt/slam/slam.hpp"

namespace cca {

void Slam::startPart(int frame) {
  view_ = {frame};
  loop_closer_.forgetDoubtful();
  elsewhere_.reset();
  // The scans in doubt were the first that were taken here, where they agree with the last of them.
  const std::size_t earlier = doubt_.surfaces.empty() ? 0 : doubt_.surfaces.size() - 1;
  for (std::size_t k = 0; k < earlier; ++k) {
    Passed& scan = passed_[passed_.size() - earlier + k];
    scan.T_frame_sensor =
        T_map_sensor_.inverse() * frames_.graph.pose(scan.frame) * scan.T_frame_sensor;
    scan.frame = frame;
    scan.is_doubtful = !agreesWithFrame(doubt_.surfaces[k], frame, scan.T_frame_sensor);
  }
  doubt_ = {};
  if (frame > 0) ++version_;  // what was seen in doubt is nowhere in the map
}

std::optional<int> Slam::soughtPart(int frame) const {
  const PoseGraph& graph = frames_.graph;
  const bool is_own = frame >= remembered_ || frames_.size() == remembered_;
  if (!is_own) return std::nullopt;
  if (graph.part(frame) != map_part_) return map_part_;
  if (!isInMemory()) return graph.part(0);
  return std::nullopt;
}

/// Of the robot's own drive: the memory of a place that it is not in is no map of it.
int Slam::largestPart() const {
  std::vector<int> frames_of(static_cast<std::size_t>(frames_.size()), 0);
  for (int k = remembered_; k < frames_.size(); ++k) {
    ++frames_of[static_cast<std::size_t>(frames_.graph.part(k))];
  }
  return static_cast<int>(std::max_element(frames_of.begin(), frames_of.end()) - frames_of.begin());
}

void Slam::finish(const DoAll& do_all) {
  work_ = {};
  while (!isSettled()) workOnce();
  if (frames_.size() > remembered_) map_part_ = largestPart();
  loop_closer_.forgetDoubtful();
  bool closed = false;
  for (int k = 0; k < frames_.size(); ++k) {
    const auto part = soughtPart(k);
    if (!part) continue;
    loop_closer_.beginAnywhere(frames_, k, *part);
    std::vector<GraphEdge> loops;
    while (loop_closer_.isSearching())
      loops = loop_closer_.advance(frames_, std::numeric_limits<int>::max());
    if (loops.empty()) continue;
    connectLoops(frames_.graph, loops);
    map_part_ = frames_.graph.part(map_part_);
    closed = true;
  }
  measureWaysAnew();
  if (closed) frames_.graph.settle(true);
  adjust(frames_, 10, do_all);
}

bool Slam::isLost() const {
  return frames_.size() > remembered_ && frames_.graph.part(frames_.size() - 1) != map_part_;
}

bool Slam::isInMemory() const {
  return remembered_ == 0 || frames_.size() == remembered_ || frames_.graph.part(0) == map_part_;
}

void Slam::remember(const SlamMemory& memory) {
  assert(frames_.size() == remembered_ &&
         memory.scans.size() == static_cast<std::size_t>(memory.graph.size()));
  for (const KeyScan& key : memory.scans) {
    const int frame = frames_.graph.add(memory.graph.pose(frames_.size() - remembered_));
    frames_.surfaces.push_back(scanSurface(key.scan));
    key_scans_.push_back(key);
    at_version_.push_back(frames_.graph.pose(frame));
    passed_.push_back({frame, {}, key.T_robot_sensor, false});
  }
  for (GraphEdge edge : memory.graph.edges()) {
    edge.from += remembered_;
    edge.to += remembered_;
    frames_.graph.connect(edge);
  }
  remembered_ = frames_.size();
}

SlamMemory Slam::memory() const {
  SlamMemory memory;
  std::vector<int> number(static_cast<std::size_t>(frames_.size()), -1);
  const PoseGraph& graph = frames_.graph;
  for (int k = 0; k < frames_.size(); ++k) {
    if (graph.part(k) != map_part_) continue;
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

std::vector<bool> Slam::isPlaced() const {
  std::vector<bool> placed;
  for (const Passed& scan : passed_) {
    placed.push_back(!scan.is_doubtful && frames_.graph.part(scan.frame) == map_part_);
  }
  return placed;
}

std::vector<bool> Slam::isSetAside() const {
  std::vector<bool> set_aside;
  for (const Passed& scan : passed_) set_aside.push_back(scan.is_doubtful);
  return set_aside;
}

std::vector<Pose2> Slam::trajectory() const {
  std::vector<Pose2> poses;
  for (const Passed& scan : passed_) {
    poses.push_back(frames_.graph.pose(scan.frame) * scan.T_frame_sensor *
                    scan.T_robot_sensor.inverse());
  }
  return poses;
}

}  // namespace cca
