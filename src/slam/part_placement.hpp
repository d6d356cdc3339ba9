// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "slam/loop_closing.hpp"

namespace cca {

/// What the rays of a part's frames within 20 m of a loop, and of those around them in the other
/// part, say of each other where the loop puts the part: some forty frames are asked.
/// Cost: a millisecond at the most.
SightCount sightsOfParts(const KeyFrames& frames, const LoopVerdict& loop);

/// Where a part of the graph lies in another one. Each place that a search finds, and each rival
/// that scores nearly as well, is a hypothesis. Rooms that look alike are told apart by all scans
/// of the part together: a hypothesis is believed when two frames have found it, or one finds it
/// where the odometry had the robot go on, the part has driven two metres, and the scans contradict
/// every other one clearly more.
class PartPlacement {
 public:
  /// @param found  a place in another part, or its rival. Nothing happens where rays contradict it.
  void add(const KeyFrames& frames, const LoopVerdict& found);
  /// The two loops that are believed, or the one that the odometry bears out, of all hypotheses
  /// about this part in the other one; none while nothing decides.
  std::vector<LoopVerdict> decide(const KeyFrames& frames, int part, int other_part) const;

 private:
  struct Hypothesis {
    std::vector<LoopVerdict> loops;  ///< that say the same, the latest last
  };
  void forgetJoined(const PoseGraph& graph);

  std::vector<Hypothesis> hypotheses_;
};

}  // namespace cca
