// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_closer.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// Two loops speak of one place where they lie this near [m] to each other.
constexpr double kNeighbourWay = 12.0;
/// The more places were offered, the more likely one of them agrees by chance, most of all where
/// the right one has not been seen yet and its like has: rays have to agree by more in wide windows
/// [m].
constexpr double kAgreeNear = 0.8, kNearWindow = 1.0;
/// Between shelves, or doors, one place is as another a few metres on, whose like has not been seen
/// yet: nothing but the way can tell. What moves by more than this [m] has to be likely.
constexpr double kFarMove = 3.0, kLikelySigmas = 1.5;

/// So many frames are asked for visits at once, a tenth of what one search takes each: where each
/// scan is a frame, the search keeps up.
constexpr int kFramesAtOnce = 3;

}  // namespace

bool saySamePlace(const PoseGraph& graph, const LoopVerdict& a, const LoopVerdict& b) {
  if (graph.part(a.candidate) != graph.part(b.candidate) ||
      graph.part(a.frame) != graph.part(b.frame)) {
    return false;
  }
  const Pose2 T_b_a = graph.pose(b.candidate).inverse() * graph.pose(a.candidate);
  const Pose2 T_frames = graph.pose(a.frame).inverse() * graph.pose(b.frame);
  const Pose2 off = (T_b_a * a.T_candidate_frame * T_frames).inverse() * b.T_candidate_frame;
  // Both chains may have drifted a little between the two.
  const double way = T_b_a.position().norm() + T_frames.position().norm();
  return way < kNeighbourWay && off.position().norm() < 0.15 + 0.02 * way &&
         std::abs(off.theta) < 0.03 + 0.005 * way;
}

bool isCredible(const LoopVerdict& verdict) {
  const double doubt = (1.0 - kAgreeNear) * kNearWindow / std::max(kNearWindow, verdict.window);
  return verdict.agreement > std::min(1.0 - doubt, kAgreeAnywhere) &&
         verdict.moved <= std::max(kFarMove, kLikelySigmas * verdict.sigma) &&
         verdict.moved <= M_SQRT2 * verdict.window &&  // the match after the search may slide away
         verdict.common > kLeastCommon && !verdict.has_rival;
}

bool LoopCloser::beginNext(const KeyFrames& frames) {
  for (int asked = 0; asked < kFramesAtOnce && !sought_.empty(); ++asked) {
    Sought& sought = sought_.front();
    if (!sought.candidates) {
      sought.candidates = loopCandidates(frames, sought.frame);
      std::reverse(sought.candidates->begin(), sought.candidates->end());
    }
    if (!sought.candidates->empty()) {
      search_.emplace(PlaceSearch::atVisit(frames, sought.frame, sought.candidates->back()));
      sought.candidates->pop_back();
      if (sought.candidates->empty()) sought_.pop_front();
      return true;
    }
    sought_.pop_front();
  }
  return false;
}

void LoopCloser::beginAnywhere(const KeyFrames& frames, int frame, int part) {
  search_.emplace(PlaceSearch::anywhere(frames, frame, part));
}

std::vector<GraphEdge> LoopCloser::advance(const KeyFrames& frames, int cells) {
  if (!search_->advance(cells)) return {};
  const auto verdict = search_->verdict(frames);
  const auto rival = search_->rival(frames);
  search_.reset();
  if (!verdict) return {};
  verdicts_.push_back(*verdict);
  const bool joins = frames.graph.part(verdict->frame) != frames.graph.part(verdict->candidate);
  const std::vector<GraphEdge> edges =
      joins ? takeBetweenParts(frames, *verdict, rival) : take(frames.graph, *verdict);
  // The frame's other visits are of no concern any more.
  if (!edges.empty() && !sought_.empty() && sought_.front().frame == verdict->frame) {
    sought_.pop_front();
  }
  return edges;
}

std::vector<GraphEdge> LoopCloser::take(const PoseGraph& graph, const LoopVerdict& verdict) {
  if (!isCredible(verdict)) return {};
  const auto second = std::find_if(waiting_.begin(), waiting_.end(), [&](const auto& other) {
    return other.frame != verdict.frame && saySamePlace(graph, verdict, other);
  });
  if (second == waiting_.end()) {
    waiting_.push_back(verdict);
    return {};
  }
  const std::vector<GraphEdge> edges{believed(*second), believed(verdict)};
  waiting_.clear();
  return edges;
}

std::vector<GraphEdge> LoopCloser::takeBetweenParts(const KeyFrames& frames,
                                                    const LoopVerdict& verdict,
                                                    const std::optional<LoopVerdict>& rival) {
  placement_.add(frames, verdict);
  if (rival) placement_.add(frames, *rival);
  std::vector<GraphEdge> edges;
  for (const LoopVerdict& loop : placement_.decide(frames, frames.graph.part(verdict.frame),
                                                   frames.graph.part(verdict.candidate))) {
    edges.push_back(believed(loop));
  }
  return edges;
}

GraphEdge LoopCloser::believed(const LoopVerdict& verdict) {
  loops_.push_back(verdict);
  return {verdict.candidate, verdict.frame, verdict.T_candidate_frame, verdict.information,
          EdgeKind::kLoop};
}

void connectLoops(PoseGraph& graph, const std::vector<GraphEdge>& loops) {
  const GraphEdge& loop = loops.back();
  const int part = graph.part(loop.to);
  if (part != graph.part(loop.from)) {
    const Pose2 T_map_frame = graph.pose(loop.from) * loop.T_from_to;
    graph.movePart(part, T_map_frame * graph.pose(loop.to).inverse());
  }
  for (const GraphEdge& edge : loops) graph.connect(edge);
}

}  // namespace cca
