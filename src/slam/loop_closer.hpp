// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "slam/loop_closing.hpp"
#include "slam/part_placement.hpp"

namespace cca {

/// Whether a loop speaks for itself: rays agree, enough was seen on both visits, and no other place
/// is nearly as good.
bool isCredible(const LoopVerdict& verdict);

/// Whether two loops, at most 12 m of way apart, lay one visit onto the other alike.
bool saySamePlace(const PoseGraph& graph, const LoopVerdict& a, const LoopVerdict& b);

/// Which of the loops that are found are believed: within a part of the graph, a credible one waits
/// until a second one, of another frame, says the same; what joins two parts is decided by
/// PartPlacement.
class LoopCloser {
 public:
  /// The place of a frame will be looked for at earlier visits within its part of the graph, three
  /// at the most, after those that were asked for before.
  void seek(int frame) { sought_.push_back({frame, std::nullopt}); }
  /// Whether there is such a frame, or a search under way.
  bool isSeeking() const { return search_ || !sought_.empty(); }
  /// Whether a search is under way. No pose may move until it is at its end.
  bool isSearching() const { return search_.has_value(); }

  /// Begins to look for the next frame at a visit that it may have seen. @return whether it has
  /// begun. It has not, and may still be seeking, where none of the next few has such a visit; to
  /// find that out takes time as well, see loopCandidates().
  bool beginNext(const KeyFrames& frames);
  /// Begins to look for a frame's place anywhere in another part of the graph.
  void beginAnywhere(const KeyFrames& frames, int frame, int part);
  /// Goes on with the search under way; see PoseSearch::advance().
  /// @return the edges of the loops that were believed now, two or none.
  std::vector<GraphEdge> advance(const KeyFrames& frames, int cells);

  /// Others are believed instead.
  void believe(std::vector<LoopVerdict> loops) { loops_ = std::move(loops); }
  /// What waits for a second one waits no more.
  void forgetDoubtful() { waiting_.clear(); }

  const std::vector<LoopVerdict>& loops() const { return loops_; }  ///< believed
  const std::vector<LoopVerdict>& verdicts() const { return verdicts_; }

 private:
  struct Sought {
    int frame;
    std::optional<std::vector<RelativeSigma>> candidates;  ///< left, the first one last
  };
  std::vector<GraphEdge> take(const PoseGraph& graph, const LoopVerdict& verdict);
  std::vector<GraphEdge> takeBetweenParts(const KeyFrames& frames, const LoopVerdict& verdict,
                                          const std::optional<LoopVerdict>& rival);
  GraphEdge believed(const LoopVerdict& verdict);

  std::deque<Sought> sought_;
  std::optional<PlaceSearch> search_;
  std::vector<LoopVerdict> verdicts_, waiting_, loops_;
  PartPlacement placement_;
};

/// The graph with the edges of loops. Where they lead to another part, the frame's own part is
/// moved there as one body, and both become one.
void connectLoops(PoseGraph& graph, const std::vector<GraphEdge>& loops);

}  // namespace cca
