// SPDX-License-Identifier: BSD-3-Clause
#include "slam/graph_back_end.hpp"

#include <algorithm>
#include <limits>

namespace cca {
namespace {

/// Cells of the likelihood pyramid that a search looks up in one scan: some 5 ms. Of a lost robot
/// in an office it takes five to ten times as many, and a key frame at walking pace as many scans.
constexpr int kCellsAtOnce = 2000000;
/// Poses are solved for again when the graph has grown by this, and by this share: all solutions of
/// a drive together cost a few of the last one.
constexpr int kOptimiseAfter = 15, kOptimiseShare = 10;
/// Rounds of the bundle adjustment: from its first reach to its last in five, and as many there.
constexpr int kAdjustRounds = 10;

}  // namespace

SlamWork& SlamWork::operator+=(const SlamWork& other) {
  searches += other.searches;
  iterations += other.iterations;
  return *this;
}

void GraphBackEnd::connectOdometry(PoseGraph& graph, const GraphEdge& edge,
                                   std::optional<double> scale) {
  if (scale) odometry_edges_.push_back({static_cast<int>(graph.edges().size()), *scale});
  graph.connect(edge);
}

void GraphBackEnd::connectMatch(PoseGraph& graph, const GraphEdge& edge) {
  has_new_edges_ = has_new_edges_ || edge.kind == EdgeKind::kLoop;
  graph.connect(edge);
}

void GraphBackEnd::add(const PoseGraph& graph, const MapPart& map, int frame) {
  loop_closer_.seek(frame);
  if (map.partToJoin(graph, frame)) to_join_.push_back(frame);
}

bool GraphBackEnd::advance(KeyFrames& frames, MapPart& map, double scale) {
  if (optimisation_) {
    ++work_.iterations;
    if (!optimisation_->advance()) return false;
    applyOptimisation(frames, map);
    return true;
  }
  if (loop_closer_.isSeeking() || !to_join_.empty()) {
    const std::vector<GraphEdge> loops = searchLoopStep(frames, map);
    if (!loops.empty()) startOptimisation(frames.graph, scale, loops);
    return false;
  }
  const int grown = frames.size() - 1 - last_optimised_;
  const int share = (frames.size() - 1) / kOptimiseShare;
  if (has_new_edges_ && grown >= std::max(kOptimiseAfter, share)) {
    startOptimisation(frames.graph, scale, {});
  }
  return false;
}

/// Goes on looking for a frame at a visit, or in another part of the graph.
std::vector<GraphEdge> GraphBackEnd::searchLoopStep(const KeyFrames& frames, const MapPart& map) {
  if (!loop_closer_.isSearching() && !loop_closer_.beginNext(frames)) {
    if (loop_closer_.isSeeking() || to_join_.empty()) return {};
    const int frame = to_join_.front();
    to_join_.pop_front();
    const auto part = map.partToJoin(frames.graph, frame);
    if (!part) return {};
    loop_closer_.beginAnywhere(frames, frame, *part);
  }
  ++work_.searches;
  return loop_closer_.advance(frames, kCellsAtOnce);
}

void GraphBackEnd::startOptimisation(PoseGraph& graph, double scale,
                                     const std::vector<GraphEdge>& loops) {
  closing_ = loops;
  rescaleOdometryEdges(graph, scale);
  PoseGraph with_loops = graph;
  if (!closing_.empty()) connectLoops(with_loops, closing_);
  optimisation_.emplace(with_loops, !closing_.empty());
  last_optimised_ = graph.size() - 1;
  has_new_edges_ = false;
}

void GraphBackEnd::applyOptimisation(KeyFrames& frames, MapPart& map) {
  PoseGraph& graph = frames.graph;
  optimisation_->applyTo(graph);
  optimisation_.reset();
  has_joined_ = false;
  if (closing_.empty()) return;
  const int closed = closing_.back().to;
  has_joined_ = graph.part(closing_.back().from) != graph.part(closed);
  for (const GraphEdge& edge : closing_) graph.connect(edge);
  map.update(graph);
  closing_.clear();
  // From the frame that closed the loop on, whose surroundings alone know of it so far.
  connectRevisits(frames, closed);
  const int last = frames.size() - 1;
  for (int k = std::max(closed + 1, last + 1 - kViewFrames); k <= last; ++k) {
    connectRevisits(frames, k);
  }
}

/// Matches a frame to those of other visits in its view; the next optimisation takes these in.
void GraphBackEnd::connectRevisits(KeyFrames& frames, int frame) {
  for (const int other : framesInView(frames, frame, frames.graph.pose(frame), kViewFrames)) {
    if (other >= frame - kViewFrames) continue;
    const auto edge = matchEdge(frames, other, frame, kRevisitMatch);
    if (edge) frames.graph.connect(*edge);
    has_new_edges_ = has_new_edges_ || edge;
  }
}

/// By what is known of the odometry now: where no wall told how far the robot had gone, it alone
/// did.
void GraphBackEnd::rescaleOdometryEdges(PoseGraph& graph, double scale) {
  for (OdometryEdge& odometry : odometry_edges_) {
    graph.lengthen(odometry.edge, scale / odometry.scale);
    odometry.scale = scale;
  }
}

void GraphBackEnd::finish(KeyFrames& frames, MapPart& map, double scale, const DoAll& do_all) {
  if (map.hasDriven(frames.graph)) map.chooseLargest(frames.graph);
  loop_closer_.forgetDoubtful();
  bool has_closed = false;
  for (int k = 0; k < frames.size(); ++k) {
    const auto part = map.partToJoin(frames.graph, k);
    if (!part) continue;
    loop_closer_.beginAnywhere(frames, k, *part);
    std::vector<GraphEdge> loops;
    while (loop_closer_.isSearching()) {
      loops = loop_closer_.advance(frames, std::numeric_limits<int>::max());
    }
    if (loops.empty()) continue;
    connectLoops(frames.graph, loops);
    map.update(frames.graph);
    has_closed = true;
  }
  rescaleOdometryEdges(frames.graph, scale);
  if (has_closed) frames.graph.settle(true);
  adjust(frames, kAdjustRounds, do_all);
  reviewEdges(frames, map, do_all);
}

void GraphBackEnd::reviewEdges(KeyFrames& frames, const MapPart& map, const DoAll& do_all) {
  const auto wheelEdgesOf = [](const PoseGraph& graph) {
    std::vector<int> numbers;
    for (std::size_t k = 0; k < graph.edges().size(); ++k) {
      if (graph.edges()[k].kind == EdgeKind::kWheels) numbers.push_back(static_cast<int>(k));
    }
    return numbers;
  };
  const std::vector<int> before = wheelEdgesOf(frames.graph);
  review_ =
      reviewLoops(frames, loop_closer_.loops(), loop_closer_.verdicts(), map.remembered(), do_all);
  if (!review_.has_changed) return;
  loop_closer_.believe(review_.loops);
  const std::vector<int> after = wheelEdgesOf(frames.graph);  // the same ones
  for (OdometryEdge& odometry : odometry_edges_) {
    const auto found = std::lower_bound(before.begin(), before.end(), odometry.edge);
    odometry.edge = after[static_cast<std::size_t>(found - before.begin())];
  }
}

}  // namespace cca
