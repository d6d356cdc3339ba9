// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "slam/correlative_search.hpp"
#include "slam/key_frames.hpp"

namespace cca {

/// Another visit of a place, as the search found it, with what speaks for and against it.
struct LoopVerdict {
  int frame = 0;      ///< the later visit
  int candidate = 0;  ///< the earlier one
  Pose2 T_candidate_frame;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< axes of the candidate
  double score = 0.0;      ///< mean likelihood of the recent frames' returns, [0, 1]
  bool has_rival = false;  ///< elsewhere in the window something scores kRival of that
  double agreement = 0.0;  ///< of the rays of both visits, [0, 1]
  double common = 0.0;     ///< share of the recent returns that the earlier visit saw, too
  double window = 0.0;     ///< m, half width that was searched
  double moved = 0.0;      ///< m, of the frame, from where the graph had it; 0 where it had none
  double sigma = 0.0;      ///< m, an upper bound of what the graph knows that by
};

/// A place that scores this share of the best one could as well be it.
inline constexpr double kRival = 0.9;
/// Share of the rays that agree with a place: among all places of a building, chance comes to less.
inline constexpr double kAgreeAnywhere = 0.92;
/// Of the rays; what fewer say decides nothing.
inline constexpr double kLeastCommon = 0.15;

/// Earlier frames that may have seen the place of `frame` although they are not tied to it: for
/// each other visit, the one most likely nearest.
std::vector<RelativeSigma> loopCandidates(const KeyFrames& frames, int frame);

/// Looks for the place of a frame, and of those driven just before, at an earlier visit or anywhere
/// in another part of the graph; bit by bit, while the graph grows, but no pose of it may move.
class PlaceSearch {
 public:
  /// At an earlier visit, in the window that the covariance leaves.
  static PlaceSearch atVisit(const KeyFrames& frames, int frame, const RelativeSigma& candidate);
  /// Among all frames of another part of the graph: the robot has been carried away, or goes on
  /// with an earlier map. Returns have to face as the surfaces do. Cost: 20 ms for 1000 frames.
  /// @param part  PoseGraph::part() of these.
  static PlaceSearch anywhere(const KeyFrames& frames, int frame, int part);

  /// Goes on; see PoseSearch::advance(). @return whether it is at its end.
  bool advance(int cells);
  /// Goes on to the end.
  void run();
  /// At the end: where it is; nothing where nothing is alike.
  std::optional<LoopVerdict> verdict(const KeyFrames& frames) const;
  /// At the end of a search anywhere: the place that scores nearly as well, if there is one.
  std::optional<LoopVerdict> rival(const KeyFrames& frames) const;

 private:
  LoopVerdict verdictAnywhere(const KeyFrames& frames, const SearchResult& there) const;
  PlaceSearch(const LoopVerdict& known, const std::optional<Pose2>& T_candidate_frame,
              std::vector<int> recent, std::vector<int> among, PoseSearch search);

  LoopVerdict known_;                       // before the search
  std::optional<Pose2> T_candidate_frame_;  // as the graph has it; none: anywhere
  std::vector<int> recent_;                 // frames that look for their place together
  std::vector<int> among_;                  // frames that they are compared with
  PoseSearch search_;
  std::optional<SearchResult> best_;
};

}  // namespace cca
