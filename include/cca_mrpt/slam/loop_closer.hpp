// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "cca_mrpt/slam/loop_closing.hpp"

namespace cca {

/// Whether a loop speaks for itself: rays agree, enough was seen on both visits, and no other place
/// is nearly as good.
bool isCredible(const LoopVerdict& verdict);

/// Which of the loops that are found are believed: a credible one waits until a second one, of
/// another frame, says the same.
class LoopCloser {
 public:
  /// The place of a frame will be looked for at earlier visits within its part of the graph, after
  /// those that were asked for before.
  void seek(int frame) { sought_.push_back({frame, std::nullopt}); }
  /// Whether there is such a frame.
  bool isSeeking() const { return !sought_.empty(); }
  /// Goes on to the next frame that may have been seen at an earlier visit. @return whether there
  /// is one: seekOnce() has something to do. It has not, and may still be seeking, where none of
  /// the next few has; to find that out takes time as well, see loopCandidates().
  bool findCandidates(const KeyFrames& frames);
  /// Looks for that frame at the next one of these visits, of three at the most.
  /// @return the edges of the loops that were believed now, two or none.
  /// Cost: see findLoop().
  std::vector<GraphEdge> seekOnce(const KeyFrames& frames);

  /// Looks for a frame's place anywhere in another part of the graph; edges as above.
  /// @param part  PoseGraph::part() of that part's frames.
  /// Cost: see relocate().
  std::vector<GraphEdge> findPlace(const KeyFrames& frames, int frame, int part);

  /// What waits for a second one waits no more.
  void forgetDoubtful() { waiting_.clear(); }

  const std::vector<LoopVerdict>& loops() const { return loops_; }  ///< believed
  const std::vector<LoopVerdict>& verdicts() const { return verdicts_; }

 private:
  struct Sought {
    int frame;
    std::optional<std::vector<RelativeCovariance>> candidates;  ///< left, the first one last
  };
  std::vector<GraphEdge> take(const PoseGraph& graph, const LoopVerdict& verdict);
  GraphEdge believed(const LoopVerdict& verdict);

  std::deque<Sought> sought_;
  std::vector<LoopVerdict> verdicts_, waiting_, loops_;
};

/// The graph with the edges of loops. Where they lead to another part, the frame's own part is
/// moved there as one body, and both become one.
void connectLoops(PoseGraph& graph, const std::vector<GraphEdge>& loops);

}  // namespace cca
