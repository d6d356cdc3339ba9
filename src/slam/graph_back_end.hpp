// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "slam/key_frames.hpp"
#include "slam/loop_closer.hpp"
#include "slam/loop_review.hpp"
#include "slam/map_part.hpp"

namespace cca {

/// What a scan costs besides finding its own pose: one of these at the most.
struct SlamWork {
  int searches = 0;    ///< bits of a loop search or of a relocalisation in another part
  int iterations = 0;  ///< of the least squares over the graph

  SlamWork& operator+=(const SlamWork& other);
};

/// Loop closing, relocalisation and optimisation of the pose graph, spread over the scans that
/// follow a key frame: a bit with each scan. How many scans a loop takes is a matter of counts,
/// never of time.
class GraphBackEnd {
 public:
  /// Ties a new key frame to the last one by odometry.
  /// @param scale  1 + MotionPrior::longer(), by which its way has been taken; nothing: it was not
  ///               measured, and is not corrected later.
  void connectOdometry(PoseGraph& graph, const GraphEdge& edge, std::optional<double> scale);
  /// Ties two key frames by an edge of a match; one of a revisit waits for the next optimisation.
  void connectMatch(PoseGraph& graph, const GraphEdge& edge);
  /// Queues the search for earlier visits of a key frame, and its relocalisation where it is in a
  /// part of its own.
  void add(const PoseGraph& graph, const MapPart& map, int frame);
  /// A part of the graph begins: no loop waits for a second one any more.
  void beginPart() { loop_closer_.forgetDoubtful(); }

  /// Does one bit of the work that waits.
  /// @param scale  by which a way of the odometry is to be taken now, see connectOdometry().
  /// @return  whether poses of the graph have been corrected.
  bool advance(KeyFrames& frames, MapPart& map, double scale);
  /// Whether the last correction joined two parts.
  bool hasJoined() const { return has_joined_; }
  /// Relocalises the frames of all lost parts once more, and solves for all poses by all scans
  /// (bundle adjustment), with another set of loops where the visits contradict one another.
  /// @param do_all  shares out what can be done at once; see adjust().
  void finish(KeyFrames& frames, MapPart& map, double scale, const DoAll& do_all);

  /// Whether nothing waits.
  bool isIdle() const { return !optimisation_ && !loop_closer_.isSeeking() && to_join_.empty(); }
  /// What was done since restartCount().
  const SlamWork& work() const { return work_; }
  void restartCount() { work_ = {}; }
  const LoopCloser& loopCloser() const { return loop_closer_; }
  /// Of the last finish().
  const LoopReview& review() const { return review_; }

 private:
  struct OdometryEdge {
    int edge;      ///< of the graph
    double scale;  ///< by which its way has been taken
  };
  std::vector<GraphEdge> searchLoopStep(const KeyFrames& frames, const MapPart& map);
  void startOptimisation(PoseGraph& graph, double scale, const std::vector<GraphEdge>& loops);
  void applyOptimisation(KeyFrames& frames, MapPart& map);
  void connectRevisits(KeyFrames& frames, int frame);
  void rescaleOdometryEdges(PoseGraph& graph, double scale);
  void reviewEdges(KeyFrames& frames, const MapPart& map, const DoAll& do_all);

  LoopCloser loop_closer_;
  std::deque<int> to_join_;  ///< frames to be relocalised in other parts of the graph
  std::vector<OdometryEdge> odometry_edges_;
  std::optional<Settlement> optimisation_;  ///< under way
  std::vector<GraphEdge> closing_;  ///< loops that it is about: in the graph when it is done
  int last_optimised_ = 0;          ///< frame
  bool has_new_edges_ = false;      ///< of revisits, for which the poses have not been solved yet
  bool has_joined_ = false;
  LoopReview review_;
  SlamWork work_;
};

}  // namespace cca
