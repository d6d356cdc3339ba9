// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/sensing/sweep_motion.hpp"
#include "cca_mrpt/slam/scan_matcher.hpp"
#include "slam/correlative_search.hpp"
#include "slam/key_frames.hpp"
#include "slam/surface_matching.hpp"
#include "slam/sweep_matching.hpp"

namespace cca {

/// A scan at the pose where it fits its surroundings best.
struct LocalMatch {
  MatchResult match;
  double agreement = 0.0;  ///< of its rays with those of the nearest key frames, [0, 1]
  double in_common = 0.0;  ///< returns of which these key frames say something
};

/// m, rad; of a search around a prediction. A wider one finds the next door as well, which is for
/// loop closing to tell apart.
inline constexpr double kWidestWindowHere = 1.0, kWidestTurn = 1.0;

/// Agreement above which Gauss-Newton from the prediction suffices; no correlative search.
inline constexpr double kGoodAgreement = 0.9;

/// What the rays of two scans say of each other's returns. A return behind a wall that stood there
/// contradicts, too: by what it saw through.
SightCount mutualSights(const ScanSurface& reference, const ScanSurface& query,
                        const Pose2& T_reference_query);

/// Removes from a new key frame, and from the nearest ones in view, what the others saw through.
/// Cost: that of a match.
void removeMovers(KeyFrames& frames, int frame, const std::vector<int>& view);

/// Scan-to-map matching: the map is the key frames around the robot.
class ScanTracker {
 public:
  explicit ScanTracker(ScanMatcher matcher) : matcher_(matcher) {}

  /// The key frames that the next scans are matched with, best first.
  const std::vector<int>& view() const { return view_; }
  /// Those that have most in common with what is seen from a pose, among those tied to `anchor`.
  void lookAround(const KeyFrames& frames, int anchor, const Pose2& T_map_sensor);
  /// That frame alone.
  void lookAt(int frame) { view_ = {frame}; }

  /// Matches a scan from `start` on.
  /// @param reach  m, how far off `start` may be.
  LocalMatch matchLocally(const KeyFrames& frames, const ScanSurface& surface,
                          const PoseBelief& prior, const Pose2& start, double reach) const;

  /// Matches a scan from where it was predicted; where the prior is wide, or the scan does not
  /// agree there, after a correlative search of the prior's three sigmas.
  LocalMatch localise(const KeyFrames& frames, const ScanSurface& surface,
                      const PoseBelief& prior) const;

  /// The motion within the sweep of a scan by what is around it; see matchSweep(). Nothing where
  /// the scan does not agree with its surroundings.
  std::optional<SweepFit> sweepMotion(const KeyFrames& frames, const ScanSurface& surface,
                                      const SweptScan& sweep, const PoseBelief& prior,
                                      const SweepBelief& belief) const;

  /// Matches a scan after a search up to a metre and `half_turn` [rad] from the prior's mean,
  /// within which no place is more likely than another.
  LocalMatch searchHere(const KeyFrames& frames, const ScanSurface& surface,
                        const PoseBelief& prior, double half_turn) const;

 private:
  std::vector<PlacedSurface> nearest(const KeyFrames& frames) const;
  Pose2 correlativeSearch(const KeyFrames& frames, const ScanSurface& surface,
                          SearchWindow window) const;

  ScanMatcher matcher_;
  std::vector<int> view_;
};

/// The belief where the odometry says nothing of where the robot is: what the match finds counts.
PoseBelief withoutOdometry(PoseBelief prior);

}  // namespace cca
