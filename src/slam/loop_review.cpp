// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_review.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "slam/loop_closer.hpp"
#include "slam/loop_clusters.hpp"

namespace cca {
namespace {

constexpr int kReviews = 4;                // bound the work; each begins at the best map so far
constexpr std::size_t kMostSearches = 80;  // in a round, spread over what contradicts
constexpr int kSearchesApart = 5;          // frames: two and a half metres of way
/// Of a pair's rays that contradict one another, for the place to be looked for again.
constexpr double kContradicted = 0.1;
/// m, rad; how far the map may be off there: two and a half times as far is searched, 2 or 6 m. By
/// the bound that the graph knows, a corridor's next doors would be as likely.
constexpr double kOffBy[] = {0.75, 2.4}, kTurnedBy = 0.05;
constexpr int kRoughRounds = 5, kLastRounds = 10;  // of adjust(); the rough ones end at its reach
constexpr double kAnotherMap = 0.5;                // m, between a frame's places in two maps
constexpr double kTieAgrees = 0.9;                 // of the rays of both

struct Hypothesis {
  std::vector<LoopOfCluster> loops;  ///< all that are known
  PoseGraph graph;
  VisitAgreement agreement;
};

GraphEdge edgeOf(const LoopVerdict& loop) {
  return {loop.candidate, loop.frame, loop.T_candidate_frame, loop.information, EdgeKind::kLoop};
}

/// The graph without edges between visits.
/// @param remembered  all edges of the first frames stay.
PoseGraph withoutLoops(const PoseGraph& graph, int remembered) {
  PoseGraph chain;
  for (int k = 0; k < graph.size(); ++k) chain.add(graph.pose(k));
  for (const GraphEdge& edge : graph.edges()) {
    const bool is_old = edge.from < remembered && edge.to < remembered;
    if (edge.kind != EdgeKind::kLoop || is_old) chain.connect(edge);
  }
  return chain;
}

bool haveEqualParts(const PoseGraph& a, const PoseGraph& b) {
  for (int k = 0; k < a.size(); ++k) {
    if (a.part(k) != b.part(k)) return false;
  }
  return true;
}

/// m, at most.
double distanceOf(const PoseGraph& a, const PoseGraph& b) {
  double most = 0.0;
  for (int k = 0; k < a.size(); ++k) {
    most = std::max(most, (a.pose(k).position() - b.pose(k).position()).norm());
  }
  return most;
}

/// Whether the frames of a loop stand elsewhere than it says: the kernel has forgiven its error.
bool isOutvoted(const PoseGraph& graph, const LoopVerdict& loop) {
  const Pose2 seen = graph.pose(loop.candidate).inverse() * graph.pose(loop.frame);
  return (seen.position() - loop.T_candidate_frame.position()).norm() > kAnotherMap;
}

class LoopJury {
 public:
  LoopJury(KeyFrames& frames, int remembered, const DoAll& do_all)
      : frames_(frames), remembered_(remembered), do_all_(do_all) {}

  LoopReview review(const std::vector<LoopVerdict>& believed,
                    const std::vector<LoopVerdict>& verdicts) {
    LoopReview review;
    review.loops = believed;
    review.agreement = agreementOfVisits(frames_, do_all_);
    if (review.agreement.isGood()) return review;
    best_ = {loopsOf(believed, verdicts), frames_.graph, review.agreement};
    for (int k = 0; k < kReviews && !best_.agreement.isGood(); ++k) {
      if (!improve()) break;
      review.has_changed = true;
    }
    frames_.graph = best_.graph;
    if (review.has_changed) {
      adjust(frames_, kLastRounds, do_all_);
      best_.agreement = agreementOfVisits(frames_, do_all_);
      review.loops.clear();
      for (const LoopOfCluster& loop : best_.loops) {
        if (loop.is_believed) review.loops.push_back(loop.verdict);
      }
    }
    review.agreement = best_.agreement;
    review.hypotheses = tried_;
    review.runner_up = runnerUp();
    return review;
  }

 private:
  static std::vector<LoopOfCluster> loopsOf(const std::vector<LoopVerdict>& believed,
                                            const std::vector<LoopVerdict>& verdicts) {
    std::vector<LoopOfCluster> loops;
    for (const LoopVerdict& verdict : believed) loops.push_back({verdict, true});
    for (const LoopVerdict& verdict : verdicts) {
      const bool is_known = std::any_of(believed.begin(), believed.end(), [&](const auto& known) {
        return known.frame == verdict.frame && known.candidate == verdict.candidate;
      });
      if (is_known || verdict.agreement < kAgreeAnywhere || verdict.common < kLeastCommon) {
        continue;
      }
      loops.push_back({verdict, false});
    }
    return loops;
  }

  /// One round. @return whether a better set of loops has been found.
  bool improve() {
    numberClusters(best_.graph, best_.loops);
    std::optional<Hypothesis> better;
    const auto consider = [&](std::optional<Hypothesis> hypothesis) {
      if (!hypothesis) return;
      const double gain = hypothesis->agreement.gain();
      if (gain > (better ? better->agreement : best_.agreement).gain()) better.swap(hypothesis);
      if (hypothesis) others_.push_back({hypothesis->graph, hypothesis->agreement});
    };
    const auto isMended = [&] { return better && better->agreement.isGood(); };
    for (const double off_by : kOffBy) {
      if (!isMended()) consider(withFound(off_by));
    }
    if (!isMended()) {
      for (const LoopChange& change : changesOf(best_.loops)) consider(changed(change));
    }
    if (!better) return false;
    others_.push_back({best_.graph, best_.agreement});
    best_ = std::move(*better);
    tieVisits();
    return true;
  }

  /// With what is found near to where the map contradicts itself.
  std::optional<Hypothesis> withFound(double off_by) {
    const std::vector<LoopVerdict> found = searchAgain(off_by);
    if (found.empty()) return std::nullopt;
    PoseGraph graph = best_.graph;
    std::vector<LoopOfCluster> loops = best_.loops;
    for (const LoopVerdict& loop : found) {
      loops.push_back({loop, true});
      graph.connect(edgeOf(loop));
    }
    return solved(std::move(graph), std::move(loops));
  }

  std::optional<Hypothesis> changed(const LoopChange& change) {
    std::vector<LoopOfCluster> loops = best_.loops;
    PoseGraph graph = change.is_without ? withoutLoops(best_.graph, remembered_) : best_.graph;
    for (LoopOfCluster& loop : loops) {
      const bool is_changed = loop.cluster == change.cluster;
      if (is_changed) loop.is_believed = !change.is_without;
      // Ties between visits, which follow from loops, are made anew.
      const bool is_lacking = change.is_without ? loop.is_believed : is_changed;
      if (is_lacking) graph.connect(edgeOf(loop.verdict));
    }
    if (!haveEqualParts(graph, best_.graph)) return std::nullopt;
    return solved(std::move(graph), std::move(loops));
  }

  Hypothesis solved(PoseGraph graph, std::vector<LoopOfCluster> loops) {
    ++tried_;
    frames_.graph = std::move(graph);
    frames_.graph.settle(true);
    adjust(frames_, kRoughRounds, do_all_);
    VisitAgreement agreement = agreementOfVisits(frames_, do_all_);
    return {std::move(loops), frames_.graph, std::move(agreement)};
  }

  /// Loops near to where the map stands, at pairs of frames that contradict each other.
  std::vector<LoopVerdict> searchAgain(double off_by) {
    std::vector<FramePair> places = contradictions();
    frames_.graph = withoutLoops(best_.graph, remembered_);  // each visit by itself
    std::vector<std::optional<LoopVerdict>> verdicts(places.size());
    do_all_(static_cast<int>(places.size()), [&](int k) {
      const FramePair& pair = places[static_cast<std::size_t>(k)];
      PlaceSearch search =
          PlaceSearch::atVisit(frames_, pair.second, {pair.first, off_by, kTurnedBy});
      search.run();
      verdicts[static_cast<std::size_t>(k)] = search.verdict(frames_);
    });
    std::vector<LoopVerdict> found;
    for (const auto& verdict : verdicts) {
      if (verdict && isCredible(*verdict)) found.push_back(*verdict);
    }
    return found;
  }

  /// Pairs of two visits, those that contradict each other most first, apart from one another.
  std::vector<FramePair> contradictions() const {
    std::vector<SeenPair> pairs;
    for (const SeenPair& pair : best_.agreement.pairs) {
      const SightCount& sights = pair.sights;
      if (!pair.frames.is_same_visit && 1.0 - sights.agreement() > kContradicted &&
          sights.contradict > 0.0) {
        pairs.push_back(pair);
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const SeenPair& a, const SeenPair& b) {
      return a.sights.contradict > b.sights.contradict;
    });
    std::vector<FramePair> places;
    for (const SeenPair& pair : pairs) {
      const bool is_near = std::any_of(places.begin(), places.end(), [&](const FramePair& other) {
        return std::abs(other.first - pair.frames.first) < kSearchesApart &&
               std::abs(other.second - pair.frames.second) < kSearchesApart;
      });
      if (is_near) continue;
      places.push_back(pair.frames);
      if (places.size() == kMostSearches) break;
    }
    return places;
  }

  /// The edges of the map that stands: its loops, but those that others have outvoted, and matches
  /// of the visits that they bring together.
  void tieVisits() {
    PoseGraph graph = withoutLoops(best_.graph, remembered_);
    frames_.graph = best_.graph;
    for (LoopOfCluster& loop : best_.loops) {
      if (isOutvoted(graph, loop.verdict)) loop.is_believed = false;
      if (loop.is_believed) graph.connect(edgeOf(loop.verdict));
    }
    for (const SeenPair& pair : best_.agreement.pairs) {
      if (pair.frames.is_same_visit || pair.sights.agreement() < kTieAgrees) continue;
      const auto edge = matchEdge(frames_, pair.frames.first, pair.frames.second, kRevisitMatch);
      if (edge) graph.connect(*edge);
    }
    // A loop alone ties two parts, though it errs.
    if (haveEqualParts(graph, best_.graph)) best_.graph = std::move(graph);
  }

  std::optional<RunnerUp> runnerUp() const {
    const Other* second = nullptr;
    double distance = 0.0;
    for (const Other& other : others_) {
      const double apart = distanceOf(other.graph, frames_.graph);
      if (apart < kAnotherMap) continue;
      if (second && other.agreement.gain() <= second->agreement.gain()) continue;
      second = &other;
      distance = apart;
    }
    if (!second) return std::nullopt;
    return RunnerUp{second->agreement.excess(), distance};
  }

  struct Other {
    PoseGraph graph;
    VisitAgreement agreement;
  };
  KeyFrames& frames_;
  int remembered_;
  const DoAll& do_all_;
  Hypothesis best_;
  std::vector<Other> others_;
  int tried_ = 0;
};

}  // namespace

LoopReview reviewLoops(KeyFrames& frames, const std::vector<LoopVerdict>& believed,
                       const std::vector<LoopVerdict>& verdicts, int remembered,
                       const DoAll& do_all) {
  return LoopJury(frames, remembered, do_all).review(believed, verdicts);
}

}  // namespace cca
