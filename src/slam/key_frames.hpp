// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/slam/pose_graph.hpp"
#include "slam/scan_surface.hpp"
#include "slam/surface_matching.hpp"

namespace cca {

/// Scans that stand for what was seen around them, and the graph that ties them together: node k of
/// the graph is the sensor of frame k.
struct KeyFrames {
  std::vector<ScanSurface> surfaces;
  PoseGraph graph;

  int size() const { return graph.size(); }
  PlacedSurface placed(int k) const {
    return {&surfaces[static_cast<std::size_t>(k)], graph.pose(k)};
  }
  std::vector<PlacedSurface> placed(const std::vector<int>& frames) const;
};

/// m, rad; a new key frame after so much way, or turn of a laser that does not see all round: a
/// doorway is passed in two, and of 180 degrees nine tenths are common to neighbours.
inline constexpr double kFrameDistance = 0.5, kFrameTurn = 0.35;
/// Key frames in view of a pose that are compared with what is seen from it: five metres of way.
inline constexpr int kViewFrames = 10;

/// Length of a step [m], a turn of kFrameTurn counted as a way of kFrameDistance.
double wayWithTurns(const Pose2& step);
/// Whether a scan is to become a key frame, by what the sensor has moved since the last one.
bool isKeyFrameDue(const Pose2& T_last_now, const ScanSurface& surface);

/// Frames whose pose is known to within this [m] of another's are one place: they match by walking
/// downhill.
inline constexpr double kTiedSigma = 0.15;
/// m, up to which two scans have much in common.
inline constexpr double kCommonView = 6.0;

/// The frames that have most in common with a view from `T_map_sensor`, best first, among those
/// that are tied to frame `anchor`.
std::vector<int> framesInView(const KeyFrames& frames, int anchor, const Pose2& T_map_sensor,
                              int most);

/// What two frames say of each other where they stand now; nothing where they have too little in
/// common.
std::optional<GraphEdge> matchEdge(const KeyFrames& frames, int from, int to,
                                   const MatchScale& scale);

/// Of a match to the frames of an earlier visit, after a loop: it is off by what the loop's
/// optimisation left, as of a first match.
inline constexpr MatchScale kRevisitMatch{0.3, 0.08};
/// Frames, ten metres of way: what is nearer in the order of frames is of the same visit.
inline constexpr int kFramesOfVisit = 20;

/// Two frames of one part of the graph within the common view of each other.
struct FramePair {
  int first, second;   ///< first < second
  bool is_same_visit;  ///< ten metres of way apart at the most
};
/// Each frame with those that have most in common with it: as many of the same visit as of others.
/// @param of_each  of each of the two, at the most. @return  in the order of the frames.
std::vector<FramePair> pairsInView(const KeyFrames& frames, std::size_t of_each);

/// All frames and the scans between them made to agree: pairs of frames that see the same place are
/// matched anew where they stand, and all poses solved for at once; and again, the reach shrinking
/// (bundle adjustment). What the wheels say stays as it is.
/// @param do_all  shares out the matches of a round; the result is the same to the bit.
/// Cost: some 10 us for each pair and round, and a solution of the graph for each round.
void adjust(KeyFrames& frames, int rounds, const DoAll& do_all = doInTurn);

}  // namespace cca
