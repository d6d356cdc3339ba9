// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/slam/key_frames.hpp"

namespace cca {

/// Another visit of a place, as the search found it, with what speaks for and against it.
struct LoopVerdict {
  int frame = 0;      ///< the later visit
  int candidate = 0;  ///< the earlier one
  Pose2 T_candidate_frame;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< axes of the candidate
  double score = 0.0;      ///< mean likelihood of the recent frames' returns, [0, 1]
  double runner_up = 0.0;  ///< the best score elsewhere in the window; 0: below kRival of `score`
  double agreement = 0.0;  ///< of the rays of both visits, [0, 1]
  double common = 0.0;     ///< share of the recent returns that the earlier visit saw, too
  double window = 0.0;     ///< m, half width that was searched
  double moved = 0.0;      ///< m, of the frame, from where the graph had it; 0 where it had none
  double sigma = 0.0;      ///< m, an upper bound of what the graph knows that by
};

/// A place that scores this share of the best one could as well be it.
inline constexpr double kRival = 0.9;

/// Earlier frames that may have seen the place of `frame` although they are not tied to it: for
/// each other visit, the one most likely nearest.
std::vector<RelativeCovariance> loopCandidates(const KeyFrames& frames, int frame);

/// Looks for the place of the frame, and of those driven just before, at an earlier visit.
/// Cost: a search by branch and bound in the window that the covariance leaves.
std::optional<LoopVerdict> findLoop(const KeyFrames& frames, int frame,
                                    const RelativeCovariance& candidate);

/// Looks for the place of the frame, and of those driven just before, anywhere among the frames of
/// another part of the graph: the robot has been carried away, or goes on with an earlier map.
/// @param part  PoseGraph::part() of that part's frames.
/// Cost: grows with that part: a search by branch and bound over all of it.
std::optional<LoopVerdict> relocate(const KeyFrames& frames, int frame, int part);

}  // namespace cca
