// SPDX-License-Identifier: BSD-3-Clause
#include "slam/jump_hypothesis.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// A scan that agrees less is looked for in all directions; nearly all scans at their right pose
/// agree by more.
constexpr double kDoubtful = 0.6;
/// m; a jump is accepted after this way, or after this share of what it claims, whatever is more. A
/// turn on the spot shows nothing new.
constexpr double kLeastWayOfJump = 0.5, kWayOfClaim = 0.35;

}  // namespace

std::optional<LocalMatch> JumpHypothesis::update(const KeyFrames& frames,
                                                 const ScanTracker& tracker,
                                                 const ContradictionMonitor& monitor,
                                                 const ScanSurface& surface,
                                                 const Tracked& tracked) {
  const Pose2& T_map_frame = tracked.T_map_frame;
  const Pose2& step = tracked.motion.T_before_after;
  if (isOpen()) {
    // Odometry that knows nothing of the jump knows nothing of how it goes on.
    PoseBelief from_there = withoutOdometry(tracked.prior);
    from_there.mean = T_map_frame * T_frame_sensor_.back() * step;
    const LocalMatch there = tracker.localise(frames, surface, from_there);
    if (monitor.isClearlyBetter(there, tracked.here)) {
      T_frame_sensor_.push_back(T_map_frame.inverse() * there.match.T_map_query);
      way_ += step.position().norm();
      if (isAccepted()) return there;
      return std::nullopt;
    }
    reset();
  }
  if (tracked.here.agreement >= kDoubtful || surface.points.empty()) return std::nullopt;
  LocalMatch there = tracker.searchHere(frames, surface, tracked.prior, M_PI);
  if (!monitor.isClearlyBetter(there, tracked.here)) return std::nullopt;
  if (std::abs((tracked.prior.mean.inverse() * there.match.T_map_query).theta) > kWidestTurn) {
    const LocalMatch nearer = tracker.searchHere(frames, surface, tracked.prior, kWidestTurn);
    if (monitor.isClearlyBetter(nearer, tracked.here)) there = nearer;
  }
  const Pose2& T_map_there = there.match.T_map_query;
  T_frame_sensor_ = {T_map_frame.inverse() * T_map_there};
  claim_ = wayWithTurns(tracked.prior.mean.inverse() * T_map_there);
  way_ = 0.0;
  return std::nullopt;
}

bool JumpHypothesis::mayBeSlip() const {
  return isOpen() && claim_ <= wayWithTurns({kWidestWindowHere, 0.0, kWidestTurn});
}

bool JumpHypothesis::isAccepted() const {
  const int scans = static_cast<int>(T_frame_sensor_.size());
  return scans >= kStandingScans ||
         (scans > 1 && way_ >= std::max(kLeastWayOfJump, kWayOfClaim * claim_));
}

}  // namespace cca
