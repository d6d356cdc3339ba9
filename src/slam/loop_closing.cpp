// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_closing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cca {
namespace {

constexpr double kMostSigma = 8.0;  // m, beyond which a place is looked for anywhere else; and of
                                    // a half window, for the cost grows with its square
constexpr double kSigmas = 2.5;     // half window: 98.8 % of what is likely
constexpr int kRecent = 8;          // frames that look for their place together
constexpr double kRecentWay = 8.0;  // m; what lies farther back has drifted from the frame
constexpr int kEarlier = 12;        // frames that they are compared with
constexpr double kCell = 0.1;       // m, of the search; matches reach 0.3 m
constexpr int kLevels = 4;          // coarsest cells of 1.6 m: five to the widest half window
constexpr int kLevelsAnywhere = 6;  // 13 m, for a whole building
constexpr double kSpacing = 0.2;    // m, of the returns that search
constexpr double kReach = 15.0;     // m, of the returns that are searched among
/// Of the best place in a window, to be matched and judged by rays at all; these decide.
constexpr double kLeastScore = 0.45;
/// Among all places of a building some score so much without being the right one; those that rays
/// agree with score .88 and more.
constexpr double kLeastScoreAnywhere = 0.8;
constexpr double kCellAnywhere = 0.2, kSpacingAnywhere = 0.4;  // m, twice the others: a first place
constexpr double kRivalDistance = 0.6, kRivalTurn = 0.3;  // m, rad, from the best place at least

/// Returns of frames in the axes that `T_base_map` leads to.
std::vector<SurfacePoint> pointsOf(const KeyFrames& frames, const std::vector<int>& of,
                                   const Pose2& T_base_map, double reach) {
  std::vector<SurfacePoint> points;
  for (const int k : of) {
    const Pose2 T_base_k = T_base_map * frames.graph.pose(k);
    const Pose2 turn{0.0, 0.0, T_base_k.theta};
    for (const auto& point : frames.surfaces[static_cast<std::size_t>(k)].points) {
      if (point.position.norm() >= reach) continue;
      points.push_back({T_base_k * point.position, turn * point.normal});
    }
  }
  return points;
}

/// Those that face somewhere.
std::vector<SurfacePoint> facing(std::vector<SurfacePoint> points) {
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const SurfacePoint& p) { return p.normal.isZero(); }),
               points.end());
  return points;
}

/// The frame and those driven before it.
std::vector<int> recentFrames(const KeyFrames& frames, int frame) {
  std::vector<int> recent{frame};
  double way = 0.0;
  for (int k = frame; k > 0 && static_cast<int>(recent.size()) < kRecent; --k) {
    if (frames.graph.part(k - 1) != frames.graph.part(frame)) break;
    way += (frames.graph.pose(k).position() - frames.graph.pose(k - 1).position()).norm();
    if (way > kRecentWay) break;
    recent.push_back(k - 1);
  }
  return recent;
}

/// Matches the frame where the search found it, and asks the rays of both visits.
void judge(const KeyFrames& frames, const std::vector<int>& recent, const std::vector<int>& around,
           const Pose2& T_earlier_frame, LoopVerdict& verdict) {
  const int frame = verdict.frame, earlier = verdict.candidate;
  std::vector<PlacedSurface> references;
  for (const int k : around) {
    references.push_back({&frames.surfaces[static_cast<std::size_t>(k)],
                          frames.graph.pose(earlier).inverse() * frames.graph.pose(k)});
  }
  const ScanSurface& surface = frames.surfaces[static_cast<std::size_t>(frame)];
  const MatchResult match = matchSurface(surface, T_earlier_frame, {}, references, 0.4);
  verdict.T_candidate_frame = match.T_map_query;
  verdict.information = match.information;
  SightCount sights;
  for (const int k : recent) {
    const Pose2 T_earlier_k =
        verdict.T_candidate_frame * (frames.graph.pose(frame).inverse() * frames.graph.pose(k));
    const ScanSurface& seen = frames.surfaces[static_cast<std::size_t>(k)];
    for (const PlacedSurface& reference : references) {
      const Pose2 T_reference_k = reference.T_map_sensor.inverse() * T_earlier_k;
      if (T_reference_k.position().norm() > 1.5 * kCommonView) continue;
      sights += compareSights(*reference.surface, seen, T_reference_k);
      sights += compareSights(seen, *reference.surface, T_reference_k.inverse());
    }
  }
  verdict.agreement = sights.agreement();
  const double all = sights.agree + sights.contradict + sights.unseen;
  verdict.common = all > 0.0 ? sights.agree / all : 0.0;
}

}  // namespace

std::vector<RelativeSigma> loopCandidates(const KeyFrames& frames, int frame) {
  struct Likely {
    double apart;
    RelativeSigma at;
  };
  std::vector<Likely> likely;
  const Pose2& here = frames.graph.pose(frame);
  for (const RelativeSigma& at : frames.graph.surroundings(frame, kMostSigma)) {
    if (at.position <= kTiedSigma) continue;
    const double apart = (frames.graph.pose(at.node).position() - here.position()).norm();
    // The nearest place that this one may be: what lies within the uncertainty is no distance.
    const double least = std::max(0.0, apart - kSigmas * at.position);
    if (least > 0.5 * kCommonView) continue;
    likely.push_back({apart, at});
  }
  std::sort(likely.begin(), likely.end(), [](const Likely& a, const Likely& b) {
    return a.apart != b.apart ? a.apart < b.apart : a.at.node < b.at.node;
  });
  // One of each visit: frames that follow one another are one.
  std::vector<RelativeSigma> chosen;
  constexpr std::size_t kMostCandidates = 3;  // bounds what a key frame costs
  for (const Likely& next : likely) {
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const auto& other) {
      return std::abs(other.node - next.at.node) < kFramesOfVisit;
    });
    if (!known) chosen.push_back(next.at);
    if (chosen.size() == kMostCandidates) break;
  }
  return chosen;
}

PlaceSearch::PlaceSearch(const LoopVerdict& known, const std::optional<Pose2>& T_candidate_frame,
                         std::vector<int> recent, std::vector<int> among, PoseSearch search)
    : known_(known),
      T_candidate_frame_(T_candidate_frame),
      recent_(std::move(recent)),
      among_(std::move(among)),
      search_(std::move(search)) {}

PlaceSearch PlaceSearch::atVisit(const KeyFrames& frames, int frame,
                                 const RelativeSigma& candidate) {
  const int earlier = candidate.node;
  const std::vector<int> recent = recentFrames(frames, frame);
  std::vector<int> around =
      framesInView(frames, earlier, frames.graph.pose(earlier), kEarlier + kRecent);
  around.erase(std::remove_if(around.begin(), around.end(),
                              [&](int k) {
                                return std::find(recent.begin(), recent.end(), k) != recent.end();
                              }),
               around.end());
  if (static_cast<int>(around.size()) > kEarlier) around.resize(kEarlier);

  SearchWindow window;
  window.centre = frames.graph.pose(earlier).inverse() * frames.graph.pose(frame);
  LoopVerdict known;
  known.frame = frame;
  known.candidate = earlier;
  known.sigma = candidate.position;
  known.window = window.half_width = std::min(kSigmas * known.sigma + kTiedSigma, kMostSigma);
  window.half_turn = std::min(kSigmas * candidate.turn + 0.05, M_PI);
  const Pose2 T_frame_map = frames.graph.pose(frame).inverse();
  const Pose2 T_earlier_map = frames.graph.pose(earlier).inverse();
  return {known, window.centre, recent, around,
          PoseSearch(thinned(pointsOf(frames, recent, T_frame_map, kReach), kSpacing),
                     LikelihoodPyramid(pointsOf(frames, around, T_earlier_map, kFarthestSurface),
                                       Eigen::Vector2d::Zero(), kReach, kLevels, kCell),
                     window, kLeastScore)};
}

PlaceSearch PlaceSearch::anywhere(const KeyFrames& frames, int frame, int part) {
  std::vector<int> all;
  Eigen::AlignedBox2d place;
  for (int k = part; k < frames.size(); ++k) {
    if (frames.graph.part(k) != part) continue;
    all.push_back(k);
    place.extend(frames.graph.pose(k).position());
  }
  const Eigen::Vector2d centre = place.center();
  SearchWindow window;
  window.centre = {centre.x(), centre.y(), 0.0};
  window.half_turn = M_PI;
  LoopVerdict known;
  known.frame = frame;
  known.window = window.half_width = 0.5 * place.sizes().maxCoeff() + kCommonView;
  const std::vector<int> recent = recentFrames(frames, frame);
  const Pose2 T_frame_map = frames.graph.pose(frame).inverse();
  return {
      known, std::nullopt, recent, all,
      PoseSearch(thinned(facing(pointsOf(frames, recent, T_frame_map, kReach)), kSpacingAnywhere),
                 LikelihoodPyramid(pointsOf(frames, all, {}, kFarthestSurface), centre,
                                   window.half_width + kReach, kLevelsAnywhere, kCellAnywhere,
                                   LikelihoodPyramid::Facing::kAlike),
                 window, kLeastScoreAnywhere)};
}

bool PlaceSearch::advance(int cells) {
  if (!search_.advance(cells)) return false;
  if (best_ || !search_.found()) return true;
  best_ = search_.found();
  search_.seekRival(kRivalDistance, kRivalTurn, kRival * best_->score);
  return false;
}

void PlaceSearch::run() {
  while (!advance(std::numeric_limits<int>::max())) continue;
}

std::optional<LoopVerdict> PlaceSearch::verdict(const KeyFrames& frames) const {
  if (!best_) return std::nullopt;
  if (!T_candidate_frame_) return verdictAnywhere(frames, *best_);
  LoopVerdict verdict = known_;
  verdict.score = best_->score;
  verdict.has_rival = search_.found().has_value();
  judge(frames, recent_, among_, best_->T_map_query, verdict);
  verdict.moved = (verdict.T_candidate_frame.position() - T_candidate_frame_->position()).norm();
  return verdict;
}

std::optional<LoopVerdict> PlaceSearch::rival(const KeyFrames& frames) const {
  if (!best_ || !search_.found() || T_candidate_frame_) return std::nullopt;
  return verdictAnywhere(frames, *search_.found());
}

LoopVerdict PlaceSearch::verdictAnywhere(const KeyFrames& frames, const SearchResult& there) const {
  LoopVerdict verdict = known_;
  verdict.score = there.score;
  verdict.has_rival = search_.found().has_value();
  // The frame there whose view has most in common.
  const auto apart = [&](int k) {
    return (frames.graph.pose(k).position() - there.T_map_query.position()).norm();
  };
  verdict.candidate = *std::min_element(among_.begin(), among_.end(),
                                        [&](int a, int b) { return apart(a) < apart(b); });
  judge(frames, recent_, framesInView(frames, verdict.candidate, there.T_map_query, kEarlier),
        frames.graph.pose(verdict.candidate).inverse() * there.T_map_query, verdict);
  return verdict;
}

}  // namespace cca
