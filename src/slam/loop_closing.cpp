// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/loop_closing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cca_mrpt/slam/correlative_search.hpp"

namespace cca {
namespace {

constexpr double kMostSigma = 8.0;     // m, beyond which a place is looked for anywhere else
constexpr double kSigmas = 2.5;        // half window
constexpr double kWidestWindow = 8.0;  // m
constexpr int kRecent = 8;             // frames that look for their place together
constexpr double kRecentWay = 8.0;     // m
constexpr int kEarlier = 12;           // frames that they are compared with
constexpr double kCell = 0.1;          // m, of the search
constexpr int kLevels = 4;
constexpr int kLevelsAnywhere = 6;
constexpr double kSpacing = 0.2;  // m, of the returns that search
constexpr double kReach = 15.0;   // m, of the returns that are searched among
constexpr double kLeastScore = 0.45;
/// Among all places of a building some score so much without being the right one; those that rays
/// agree with score .88 and more.
constexpr double kLeastScoreAnywhere = 0.8;
constexpr double kCellAnywhere = 0.2, kSpacingAnywhere = 0.4;
constexpr double kTolerance = 0.2;  // m, within which rays agree

/// Points of frames in the axes of frame `base`.
std::vector<Eigen::Vector2d> pointsOf(const KeyFrames& frames, const std::vector<int>& of, int base,
                                      double reach) {
  std::vector<Eigen::Vector2d> points;
  for (const int k : of) {
    const Pose2 T_base_k = frames.graph.pose(base).inverse() * frames.graph.pose(k);
    for (const auto& point : frames.surfaces[static_cast<std::size_t>(k)].points) {
      if (point.position.norm() < reach) points.push_back(T_base_k * point.position);
    }
  }
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

/// The best place of a query in a window, and how good the next best elsewhere in it is.
struct Found {
  SearchResult best;
  double runner_up = 0.0;
};

std::optional<Found> foundIn(const std::vector<Eigen::Vector2d>& query,
                             const LikelihoodPyramid& pyramid, SearchWindow window,
                             double least_score) {
  const auto best = searchPose(query, pyramid, window, least_score);
  if (!best) return std::nullopt;
  Found found{*best, 0.0};
  window.excluded = best->T_map_query;
  window.excluded_distance = 0.6;
  window.excluded_turn = 0.3;
  if (const auto second = searchPose(query, pyramid, window, kRival * best->score)) {
    found.runner_up = second->score;
  }
  return found;
}

/// Matches the frame where the search found it, and asks the rays of both visits.
LoopVerdict judged(const KeyFrames& frames, int frame, int earlier, const std::vector<int>& recent,
                   const std::vector<int>& around, const Pose2& T_earlier_frame) {
  LoopVerdict verdict;
  verdict.frame = frame;
  verdict.candidate = earlier;
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
      sights += compareSights(*reference.surface, seen, T_reference_k, kTolerance);
      sights += compareSights(seen, *reference.surface, T_reference_k.inverse(), kTolerance);
    }
  }
  verdict.agreement = sights.agreement();
  const double all = sights.agree + sights.contradict + sights.unseen;
  verdict.common = all > 0.0 ? sights.agree / all : 0.0;
  return verdict;
}

}  // namespace

std::vector<RelativeCovariance> loopCandidates(const KeyFrames& frames, int frame) {
  struct Likely {
    double apart;
    RelativeCovariance at;
  };
  std::vector<Likely> likely;
  const Pose2& here = frames.graph.pose(frame);
  for (const RelativeCovariance& at : frames.graph.surroundings(frame, kMostSigma)) {
    const double sigma = std::sqrt(0.5 * at.covariance.topLeftCorner<2, 2>().trace());
    if (sigma <= kTiedSigma) continue;
    const double apart = (frames.graph.pose(at.node).position() - here.position()).norm();
    // The nearest place that this one may be: what lies within the uncertainty is no distance.
    const double least = std::max(0.0, apart - kSigmas * sigma);
    if (least > 0.5 * kCommonView) continue;
    likely.push_back({apart, at});
  }
  std::sort(likely.begin(), likely.end(), [](const Likely& a, const Likely& b) {
    return a.apart != b.apart ? a.apart < b.apart : a.at.node < b.at.node;
  });
  // One of each visit: frames that follow one another are one.
  std::vector<RelativeCovariance> chosen;
  constexpr int kSameVisit = 20;  // frames
  constexpr std::size_t kMostCandidates = 3;
  for (const Likely& next : likely) {
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const auto& other) {
      return std::abs(other.node - next.at.node) < kSameVisit;
    });
    if (!known) chosen.push_back(next.at);
    if (chosen.size() == kMostCandidates) break;
  }
  return chosen;
}

std::optional<LoopVerdict> findLoop(const KeyFrames& frames, int frame,
                                    const RelativeCovariance& candidate) {
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
  const double sigma = std::sqrt(0.5 * candidate.covariance.topLeftCorner<2, 2>().trace());
  const double turn_sigma = std::sqrt(candidate.covariance(2, 2));

  SearchWindow window;
  window.centre = frames.graph.pose(earlier).inverse() * frames.graph.pose(frame);
  window.half_width = std::min(kSigmas * sigma + kTiedSigma, kWidestWindow);
  window.half_turn = std::min(kSigmas * turn_sigma + 0.05, M_PI);
  const LikelihoodPyramid pyramid(pointsOf(frames, around, earlier, kFarthestSurface),
                                  Eigen::Vector2d::Zero(), kReach, kLevels, kCell);
  const auto found = foundIn(thinned(pointsOf(frames, recent, frame, kReach), kSpacing), pyramid,
                             window, kLeastScore);
  if (!found) return std::nullopt;
  LoopVerdict verdict = judged(frames, frame, earlier, recent, around, found->best.T_map_query);
  verdict.score = found->best.score;
  verdict.runner_up = found->runner_up;
  verdict.window = window.half_width;
  verdict.sigma = sigma;
  verdict.moved = (verdict.T_candidate_frame.position() - window.centre.position()).norm();
  return verdict;
}

std::optional<LoopVerdict> relocate(const KeyFrames& frames, int frame, int part) {
  std::vector<int> all;
  Eigen::AlignedBox2d place;
  for (int k = part; k < frames.size(); ++k) {
    if (frames.graph.part(k) != part) continue;
    all.push_back(k);
    place.extend(frames.graph.pose(k).position());
  }
  const std::vector<int> recent = recentFrames(frames, frame);
  std::vector<Eigen::Vector2d> points;
  for (const int k : all) {
    for (const auto& point : frames.surfaces[static_cast<std::size_t>(k)].points) {
      points.push_back(frames.graph.pose(k) * point.position);
    }
  }
  SearchWindow window;
  const Eigen::Vector2d centre = place.center();
  window.centre = {centre.x(), centre.y(), 0.0};
  window.half_width = 0.5 * place.sizes().maxCoeff() + kCommonView;
  window.half_turn = M_PI;
  const LikelihoodPyramid pyramid(points, centre, window.half_width + kReach, kLevelsAnywhere,
                                  kCellAnywhere);
  const auto found = foundIn(thinned(pointsOf(frames, recent, frame, kReach), kSpacingAnywhere),
                             pyramid, window, kLeastScoreAnywhere);
  if (!found) return std::nullopt;

  // The frame there whose view has most in common.
  const Pose2& there = found->best.T_map_query;
  const auto apart = [&](int k) {
    return (frames.graph.pose(k).position() - there.position()).norm();
  };
  const int earlier =
      *std::min_element(all.begin(), all.end(), [&](int a, int b) { return apart(a) < apart(b); });
  const std::vector<int> around = framesInView(frames, earlier, there, kEarlier);
  LoopVerdict verdict =
      judged(frames, frame, earlier, recent, around, frames.graph.pose(earlier).inverse() * there);
  verdict.score = found->best.score;
  verdict.runner_up = found->runner_up;
  verdict.window = window.half_width;
  return verdict;
}

}  // namespace cca
