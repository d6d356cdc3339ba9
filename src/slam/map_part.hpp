// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cca_mrpt/slam/pose_graph.hpp"

namespace cca {

/// Which part of the pose graph is the map: the graph of a lost robot, of an earlier drive and of a
/// second log are parts of their own, until a loop joins them.
///
/// The first frames of the graph may be those of earlier drives. The robot's own drive is the map
/// until it has found itself in the earliest of these.
class MapPart {
 public:
  /// The graph now holds the frames of earlier drives; none of the robot's own have come yet.
  void remember(const PoseGraph& graph) { remembered_ = graph.size(); }
  /// The number of frames of earlier drives.
  int remembered() const { return remembered_; }

  /// The frame begins the map.
  void begin(int frame) { part_ = frame; }
  /// Parts have been joined.
  void update(const PoseGraph& graph) { part_ = graph.part(part_); }
  /// The largest part of the robot's own drive becomes the map: the memory of a building that the
  /// robot is not in is no map of its drive.
  void chooseLargest(const PoseGraph& graph);

  /// Whether a frame is in the map.
  bool holds(const PoseGraph& graph, int frame) const { return graph.part(frame) == part_; }
  /// Whether the robot's own drive has begun.
  bool hasDriven(const PoseGraph& graph) const { return graph.size() > remembered_; }
  /// Whether the last frame is of the robot's own drive, and not in the map.
  bool isLost(const PoseGraph& graph) const;
  /// Whether the robot has found itself in what it remembers, or remembers nothing.
  bool isInMemory(const PoseGraph& graph) const;
  /// The part in which a frame is to be relocalised: the map, or what is remembered.
  std::optional<int> partToJoin(const PoseGraph& graph, int frame) const;

 private:
  int remembered_ = 0;
  int part_ = 0;
};

}  // namespace cca
