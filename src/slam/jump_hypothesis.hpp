// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "slam/contradiction_monitor.hpp"
#include "slam/motion_prior.hpp"
#include "slam/tracking.hpp"

namespace cca {

/// The belief that the robot has slipped or turned to another pose within a metre, which no
/// odometry tells: recent scans agree there, and not where it was tracked to.
///
/// One scan suggests the pose, from a search in all directions. Where that finds a turn of more
/// than a radian, a smaller one that explains the scan as well is taken for it: columns look alike
/// after half a turn. The pose is accepted once further scans agree there, over a way in proportion
/// to the jump: a robot that nods on braking sees the floor for a third of a metre.
class JumpHypothesis {
 public:
  /// A scan as it is tracked without a jump.
  struct Tracked {
    Pose2 T_map_frame;  ///< of the last key frame
    MotionBelief motion;
    PoseBelief prior;
    LocalMatch here;
  };

  /// Follows the hypothesis with one more scan, or looks for one where the scan agrees badly.
  /// @return  the scan at the other pose, once the jump is accepted.
  std::optional<LocalMatch> update(const KeyFrames& frames, const ScanTracker& tracker,
                                   const ContradictionMonitor& monitor, const ScanSurface& surface,
                                   const Tracked& tracked);

  bool isOpen() const { return !T_frame_sensor_.empty(); }
  /// Whether it is in question, and claims no more than a metre and a radian: a wheel may have
  /// slipped so, and the robot is not lost yet.
  bool mayBeSlip() const;
  /// The poses of the scans since the jump, in the last key frame; the newest last.
  const std::vector<Pose2>& poses() const { return T_frame_sensor_; }
  void reset() { *this = {}; }

 private:
  bool isAccepted() const;

  std::vector<Pose2> T_frame_sensor_;
  double claim_ = 0.0;  ///< m with turns, length of the jump
  double way_ = 0.0;    ///< m, driven since
};

}  // namespace cca
