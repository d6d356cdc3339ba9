// SPDX-License-Identifier: BSD-3-Clause
#include "slam/part_placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "slam/tracking.hpp"

namespace cca {
namespace {

/// Frames of a part that are asked, and frames around each of them.
constexpr std::size_t kMostAsked = 40, kJudgesOfPart = 6;
/// m; farther from the loop the part's own drift contradicts.
constexpr double kJudgedAround = 20.0;
/// m, rad; loops that put the part within this say the same. Rivals lie .6 m apart or more, and
/// two hypotheses within a metre are one that drifted.
constexpr double kSamePlace = 0.5, kSameTurn = 0.15, kNoRival = 1.0, kNoRivalTurn = 0.2;
/// m; of less way a room may have seen nothing that tells it from its like, which may be still
/// unseen.
constexpr double kLeastWayOfPart = 2.0;
/// m, the longer side of a usual room: so far it has to drive where another place was not told from
/// this one at some time, for the like of a room may be one of several; and so far apart are loops
/// that say the same of more than a room and its like.
constexpr double kLongRoom = 5.0;
/// Of the rays that say something. The right place is contradicted by .0002 to .009 (simulated
/// drives; intel and seattle, cut in two), the like of a room by .03 and more once the robot has
/// left it. A rival has to be contradicted by so many times as much, and by this more.
constexpr double kMostContradicted = 0.02, kTimesMore = 3.0, kMore = 0.005;
/// The same where nothing else is like it, and loops kLongRoom apart say the same: glass and what
/// has been moved contradict a whole visit of a museum (fhw, cut in two) by .13.
constexpr double kMostContradictedAlone = 0.15;
/// A hypothesis that puts the part beside what was seen is contradicted by nothing, and is no rival
/// of one with this many times as much in common; but for where the robot would be by its wheels.
constexpr double kMoreInCommon = 2.0;
/// Bound what a part costs: each hypothesis is judged by all scans of the part.
constexpr std::size_t kMostHypotheses = 12, kLoopsOfEach = 4;

/// Takes the part of the loop's frame to where the loop puts it.
Pose2 motionOf(const PoseGraph& graph, const LoopVerdict& loop) {
  return graph.pose(loop.candidate) * loop.T_candidate_frame * graph.pose(loop.frame).inverse();
}

bool putAlike(const PoseGraph& graph, const LoopVerdict& a, const LoopVerdict& b, double distance,
              double turn) {
  const Pose2& frame = graph.pose(a.frame);
  const Eigen::Vector3d off = difference(motionOf(graph, a) * frame, motionOf(graph, b) * frame);
  return off.head<2>().norm() < distance && std::abs(off.z()) < turn;
}

double wayOf(const PoseGraph& graph, int part) {
  double way = 0.0;
  for (int k = part + 1; k < graph.size(); ++k) {
    if (graph.part(k) != part || graph.part(k - 1) != part) continue;
    way += (graph.pose(k).position() - graph.pose(k - 1).position()).norm();
  }
  return way;
}

double contradicted(const SightCount& sights) { return 1.0 - sights.agreement(); }

/// Whether the loop puts its part where the odometry had it go on, but for a slip: what is new may
/// have nothing in common with what was seen.
bool goesOn(const PoseGraph& graph, const LoopVerdict& loop) {
  const Pose2& first = graph.pose(graph.part(loop.frame));
  const Eigen::Vector3d off = difference(motionOf(graph, loop) * first, first);
  return off.head<2>().norm() < kWidestWindowHere && std::abs(off.z()) < kWidestTurn;
}

/// Whether all scans tell the first from the second, and for the first.
bool isRefutedBy(const SightCount& best, const SightCount& other, bool other_goes_on) {
  if (!other_goes_on && kMoreInCommon * other.agree < best.agree) return true;
  return contradicted(other) > kTimesMore * contradicted(best) + kMore;
}

}  // namespace

SightCount sightsOfParts(const KeyFrames& frames, const LoopVerdict& loop) {
  const PoseGraph& graph = frames.graph;
  const int part = graph.part(loop.frame), other_part = graph.part(loop.candidate);
  const Pose2 T = motionOf(graph, loop);
  const Eigen::Vector2d centre = graph.pose(loop.frame).position();
  std::vector<int> own, others;
  for (int k = 0; k < frames.size(); ++k) {
    const int of = graph.part(k);
    if (of == part && (graph.pose(k).position() - centre).norm() < kJudgedAround) own.push_back(k);
    if (of == other_part) others.push_back(k);
  }
  const std::size_t stride = (own.size() + kMostAsked - 1) / kMostAsked;
  SightCount sights;
  for (std::size_t i = 0; i < own.size(); i += stride) {
    const Pose2 here = T * graph.pose(own[i]);
    std::vector<std::pair<double, int>> near;
    for (const int k : others) {
      const double apart = (graph.pose(k).position() - here.position()).norm();
      if (apart < kCommonView) near.push_back({apart, k});
    }
    const auto count = std::min(near.size(), kJudgesOfPart);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    near.resize(count);
    const ScanSurface& surface = frames.surfaces[static_cast<std::size_t>(own[i])];
    for (const auto& [apart, k] : near) {
      const ScanSurface& other = frames.surfaces[static_cast<std::size_t>(k)];
      const Pose2 T_other_own = graph.pose(k).inverse() * here;
      sights += compareSights(other, surface, T_other_own);
      sights += compareSights(surface, other, T_other_own.inverse());
    }
  }
  return sights;
}

void PartPlacement::add(const KeyFrames& frames, const LoopVerdict& found) {
  forgetJoined(frames.graph);
  if (found.agreement < kAgreeAnywhere || found.common < kLeastCommon) return;
  const PoseGraph& graph = frames.graph;
  const int part = graph.part(found.frame), other_part = graph.part(found.candidate);
  for (Hypothesis& hypothesis : hypotheses_) {
    const LoopVerdict& known = hypothesis.loops.back();
    if (graph.part(known.frame) != part || graph.part(known.candidate) != other_part) continue;
    if (!putAlike(graph, found, known, kSamePlace, kSameTurn)) continue;
    hypothesis.loops.push_back(found);
    // The first one stays: it tells how far the place has held.
    if (hypothesis.loops.size() > kLoopsOfEach)
      hypothesis.loops.erase(hypothesis.loops.begin() + 1);
    return;
  }
  hypotheses_.push_back({{found}});
  if (hypotheses_.size() <= kMostHypotheses) return;
  hypotheses_.erase(std::max_element(hypotheses_.begin(), hypotheses_.end(),
                                     [&](const Hypothesis& a, const Hypothesis& b) {
                                       return contradicted(sightsOfParts(frames, a.loops.back())) <
                                              contradicted(sightsOfParts(frames, b.loops.back()));
                                     }));
}

std::vector<LoopVerdict> PartPlacement::decide(const KeyFrames& frames, int part,
                                               int other_part) const {
  const PoseGraph& graph = frames.graph;
  const double way = wayOf(graph, part);
  if (way < kLeastWayOfPart) return {};
  struct Judged {
    const Hypothesis* hypothesis;
    SightCount sights;
  };
  std::vector<Judged> judged;
  for (const Hypothesis& hypothesis : hypotheses_) {
    const LoopVerdict& loop = hypothesis.loops.back();
    if (graph.part(loop.frame) != part || graph.part(loop.candidate) != other_part) continue;
    judged.push_back({&hypothesis, sightsOfParts(frames, loop)});
  }
  for (const Judged& best : judged) {
    const std::vector<LoopVerdict>& loops = best.hypothesis->loops;
    if (contradicted(best.sights) > kMostContradictedAlone) continue;
    const auto second = std::find_if(loops.begin(), loops.end(), [&](const LoopVerdict& loop) {
      return loop.frame != loops.back().frame;
    });
    const bool is_found_twice = second != loops.end();
    if (!is_found_twice && !goesOn(graph, loops.back())) continue;
    bool has_like = false, stands_alone = true;
    for (const Judged& other : judged) {
      const LoopVerdict& loop = other.hypothesis->loops.back();
      if (putAlike(graph, loop, loops.back(), kNoRival, kNoRivalTurn)) continue;
      has_like = true;
      stands_alone = stands_alone && isRefutedBy(best.sights, other.sights, goesOn(graph, loop));
    }
    const bool is_clear = contradicted(best.sights) <= kMostContradicted;
    const Eigen::Vector2d last = graph.pose(loops.back().frame).position();
    const double apart =
        is_found_twice ? (graph.pose(second->frame).position() - last).norm() : 0.0;
    const bool is_enough = has_like ? is_clear && way >= kLongRoom : is_clear || apart >= kLongRoom;
    if (!stands_alone || !is_enough) continue;
    if (is_found_twice) return {*second, loops.back()};
    return {loops.back()};
  }
  return {};
}

/// Those between parts that are one by now.
void PartPlacement::forgetJoined(const PoseGraph& graph) {
  const auto isJoined = [&](const Hypothesis& hypothesis) {
    const LoopVerdict& loop = hypothesis.loops.back();
    return graph.part(loop.frame) == graph.part(loop.candidate);
  };
  hypotheses_.erase(std::remove_if(hypotheses_.begin(), hypotheses_.end(), isJoined),
                    hypotheses_.end());
}

}  // namespace cca
