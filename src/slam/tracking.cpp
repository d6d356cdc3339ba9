// SPDX-License-Identifier: BSD-3-Clause
#include "slam/tracking.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/likelihood_pyramid.hpp"

namespace cca {
namespace {

/// Key frames that a scan which becomes no key frame is matched with: the nearest of those in view.
constexpr std::size_t kMatched = 5;
constexpr std::size_t kJudges = 3;  // frames that say how well a scan agrees with them
/// m; of a search around the pose: cells of half the least reach of a match, returns two cells
/// apart, none beyond 12 m, where beams of a degree are farther apart than these.
constexpr double kSearchCell = 0.05, kSpacingOverCell = 2.0, kSearchReach = 12.0;
/// m: all round twice as coarse, an eighth of the places, which is still a third of what a match
/// reaches.
constexpr double kCellAllRound = 0.1;
/// Coarsest cells of 0.4 m for a window of one metre. All round of 1.6 m, which nearly spans the
/// window: one bound a direction.
constexpr int kSearchLevels = 3, kLevelsAllRound = 4;
/// m, rad; a narrower window is what a match reaches by itself.
constexpr double kLeastSearch = 0.2, kLeastTurn = 0.2;
/// Share of the prior's information that is left where it is not to decide: a scan that sees
/// nothing stays where the prior has it all the same.
constexpr double kVague = 1e-3;

struct Sigmas {
  double position, turn;  // m, rad
};

Sigmas sigmasOf(const PoseBelief& prior) {
  const Eigen::Matrix3d covariance = prior.information.inverse();
  return {std::sqrt(0.5 * covariance.topLeftCorner<2, 2>().trace()), std::sqrt(covariance(2, 2))};
}

/// How far off [m] the prior may put what is seen kTurnArm away.
double spanOf(const PoseBelief& prior) {
  const Sigmas sigmas = sigmasOf(prior);
  return kPriorSigmas * (sigmas.position + kTurnArm * sigmas.turn);
}

SearchWindow windowOf(const PoseBelief& prior) {
  const Sigmas sigmas = sigmasOf(prior);
  SearchWindow window;
  window.centre = prior.mean;
  window.half_width = std::clamp(kPriorSigmas * sigmas.position, kLeastSearch, kWidestWindowHere);
  window.half_turn = std::clamp(kPriorSigmas * sigmas.turn, kLeastTurn, kWidestTurn);
  window.prior_information = prior.information.diagonal();
  return window;
}

}  // namespace

SightCount mutualSights(const ScanSurface& reference, const ScanSurface& query,
                        const Pose2& T_reference_query) {
  SightCount sights = compareSights(reference, query, T_reference_query);
  if (query.points.empty()) return sights;  // nothing at all says nothing
  sights += compareSights(query, reference, T_reference_query.inverse());
  return sights;
}

void removeMovers(KeyFrames& frames, int frame, const std::vector<int>& view) {
  std::vector<int> around{frame};
  for (std::size_t i = 0; i < view.size() && i < kJudges; ++i) around.push_back(view[i]);
  for (const int seen : around) {
    std::vector<PlacedSurface> others;
    for (const int other : around) {
      if (other != seen) others.push_back(frames.placed(other));
    }
    forgetWhatMoved(frames.surfaces[static_cast<std::size_t>(seen)], frames.graph.pose(seen),
                    others);
  }
}

PoseBelief withoutOdometry(PoseBelief prior) {
  prior.information *= kVague;
  return prior;
}

void ScanTracker::lookAround(const KeyFrames& frames, int anchor, const Pose2& T_map_sensor) {
  view_ = framesInView(frames, anchor, T_map_sensor, kViewFrames);
}

Pose2 ScanTracker::correlativeSearch(const KeyFrames& frames, const ScanSurface& surface,
                                     SearchWindow window) const {
  std::vector<SurfacePoint> points, query;
  for (const PlacedSurface& placed : frames.placed(view_)) {
    for (const auto& point : placed.surface->points) {
      points.push_back({placed.T_map_sensor * point.position});
    }
  }
  for (const auto& point : surface.points) {
    if (point.position.norm() < kSearchReach) query.push_back({point.position});
  }
  const bool is_all_round = window.half_turn > kWidestTurn;
  const double cell = is_all_round ? kCellAllRound : kSearchCell;
  query = thinned(query, kSpacingOverCell * cell);
  if (query.empty()) return window.centre;
  window.prior_weight = 1.0 / (kIndependent * 3.0 * static_cast<double>(query.size()));
  LikelihoodPyramid pyramid(points, window.centre.position(), kSearchReach + window.half_width,
                            is_all_round ? kLevelsAllRound : kSearchLevels, cell);
  const auto found = searchPose(std::move(query), std::move(pyramid), window, 0.2);
  return found ? found->T_map_query : window.centre;
}

std::vector<PlacedSurface> ScanTracker::nearest(const KeyFrames& frames) const {
  std::vector<PlacedSurface> references = frames.placed(view_);
  if (references.size() > kMatched) references.resize(kMatched);
  return references;
}

LocalMatch ScanTracker::matchLocally(const KeyFrames& frames, const ScanSurface& surface,
                                     const PoseBelief& prior, const Pose2& start,
                                     double reach) const {
  const std::vector<PlacedSurface> references = nearest(frames);
  LocalMatch found;
  found.match = matcher_(surface, start, prior, references, reach);
  SightCount sights;
  for (std::size_t i = 0; i < references.size() && i < kJudges; ++i) {
    sights += mutualSights(*references[i].surface, surface,
                           references[i].T_map_sensor.inverse() * found.match.T_map_query);
  }
  found.agreement = sights.agreement();
  found.in_common = 0.5 * (sights.agree + sights.contradict);
  return found;
}

LocalMatch ScanTracker::localise(const KeyFrames& frames, const ScanSurface& surface,
                                 const PoseBelief& prior) const {
  const SearchWindow window = windowOf(prior);
  LocalMatch found;
  if (window.half_width <= kLeastSearch && window.half_turn <= kLeastTurn) {
    const double reach = std::min(kFirstMatchReach, spanOf(prior));
    found = matchLocally(frames, surface, prior, prior.mean, reach);
  }
  if (found.agreement >= kGoodAgreement) return found;
  const Pose2 start = correlativeSearch(frames, surface, window);
  return matchLocally(frames, surface, prior, start, kFirstMatchReach);
}

std::optional<SweepFit> ScanTracker::sweepMotion(const KeyFrames& frames,
                                                 const ScanSurface& surface, const SweptScan& sweep,
                                                 const PoseBelief& prior,
                                                 const SweepBelief& belief) const {
  const LocalMatch found =
      matchLocally(frames, surface, prior, prior.mean, std::min(kFirstMatchReach, spanOf(prior)));
  if (found.agreement < kGoodAgreement) return std::nullopt;
  return matchSweep(surface, sweep, found.match.T_map_query, prior, belief, nearest(frames));
}

LocalMatch ScanTracker::searchHere(const KeyFrames& frames, const ScanSurface& surface,
                                   const PoseBelief& prior, double half_turn) const {
  SearchWindow window;
  window.centre = prior.mean;
  window.half_width = kWidestWindowHere;
  window.half_turn = half_turn;
  const Pose2 start = correlativeSearch(frames, surface, window);
  return matchLocally(frames, surface, withoutOdometry(prior), start, kFirstMatchReach);
}

}  // namespace cca
