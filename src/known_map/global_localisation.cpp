// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/global_localisation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/square_key.hpp"

namespace cca {
namespace {

/// m: more than a cell of what views have seen (kSeenCell), for a nearer view adds few rays that
/// count; and rad, a sector that a laser of a narrow field had not in view.
constexpr double kViewDistance = 0.5, kViewTurn = 0.6;
constexpr std::size_t kMostViews = 12;  // kViewDistance apart, over the six metres of kSeenCell
/// Cells of what views have seen: wheels err by less over six metres.
constexpr double kSeenCell = 0.4;  // m

// Of the search.
constexpr double kPlanCell = 0.2, kPlanStep = 0.1;  // m, of the pyramid; of the points along lines
constexpr int kPlanLevels = 6;  // coarsest cells of 12.8 m: the query's own reach
/// m: at the farthest returns a step of the search's turns, one degree, is a cell; and returns a
/// cell and a half apart, so that hardly two of them look up one cell.
constexpr double kQueryReach = 12.0, kQuerySpacing = 0.3;
constexpr double kLeastFit = 0.2;  // mean likelihood: four fifths of the returns are furniture
/// Matched to one view, five scans' work at the default effort; to kMostViews, sixty scans'.
constexpr std::size_t kMostCandidates = 300;
/// m, rad: of places so near to each other one is kept, since a match from it reaches the others
/// (kCoarse), and walls are paired up to 26 degrees aslant; 15 here.
constexpr double kCandidateDistance = 0.5, kCandidateTurn = 0.26;

constexpr double kCoarse = 0.6;  // m, reach of the match of a candidate
/// m, rad: places for which a candidate was kept lie within three of these.
constexpr double kCandidateSigma = 0.3, kCandidateTurnSigma = 0.1;
/// Rays that a room is worth, with what is seen through its door: 40 m of walls, it and the
/// corridor before it.
constexpr double kRoomRays = 160.0;
constexpr double kHopeless = -3.0;    // nats, of one view: a twentieth of a place taken at random
constexpr double kBehindBest = 25.0;  // nats: some four times kClear, by which one is believed
/// Each is matched once to a new view: the work of at most two and a half scans of a search.
constexpr std::size_t kMostHypotheses = 150;
/// m; places beside the best one, out to twice what the search keeps one place of.
constexpr double kNeighbourStep = 0.2;
constexpr int kNeighbourSteps = 5;  // to each side: twice kCandidateDistance
/// Nearer ones are the same place.
constexpr double kSamePlace = 0.3, kSameTurn = 0.15;  // m, rad
/// Of a pose that is believed. Right ones of 1200 have an agreement of .92 and more; some half a
/// metre beside the right one, .85.
constexpr double kLeastAgreement = 0.9, kLeastExplained = 0.15;
/// m, of the distances of returns from a plan that people drew: .031 to .036 at right poses in five
/// of them, by a laser of 1 cm (docs/log/localisation.md).
constexpr double kPlanNoise = 0.035;

LikelihoodPyramid pyramidOf(const PlanLines& plan) {
  std::vector<SurfacePoint> points;
  for (const PlanLines::Piece& piece : plan.pieces()) {
    const int steps = 1 + static_cast<int>(piece.length / kPlanStep);
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector2d p = piece.start + piece.direction * (piece.length * k / steps);
      points.push_back({p, piece.normal()});
      points.push_back({p, -piece.normal()});
    }
  }
  const Eigen::Vector2d centre = plan.empty() ? Eigen::Vector2d(0, 0) : plan.bounds().center();
  const double reach = plan.empty() ? 0.0 : plan.bounds().sizes().maxCoeff();
  return {points, centre, reach, kPlanLevels, kPlanCell, LikelihoodPyramid::Facing::kAlike};
}

/// What a search looks for: returns on surfaces, sensor frame.
std::vector<SurfacePoint> queryOf(const ScanSurface& surface) {
  std::vector<SurfacePoint> query;
  for (const ScanSurface::Point& p : surface.points) {
    if (p.normal.isZero() || p.position.norm() > kQueryReach) continue;
    query.push_back({p.position, p.normal});
  }
  return thinned(query, kQuerySpacing);
}

PoseBelief beliefOf(const Pose2& mean, double sigma, double turn_sigma) {
  PoseBelief belief;
  belief.mean = mean;
  const double shift = 1.0 / (sigma * sigma);
  belief.information.diagonal() << shift, shift, 1.0 / (turn_sigma * turn_sigma);
  return belief;
}

/// After a way by wheels that nobody knows.
PoseBelief beliefAfter(const Pose2& T_map_sensor, const Pose2& step) {
  const double way = step.position().norm(), turn = std::abs(step.theta);
  return beliefOf(T_map_sensor * step, 0.04 + 0.1 * way, 0.03 + 0.05 * way + 0.07 * turn);
}

bool isSamePlace(const Pose2& a, const Pose2& b) {
  const Eigen::Vector3d off = difference(a, b);
  return off.head<2>().norm() < kSamePlace && std::abs(off.z()) < kSameTurn;
}

std::int64_t seenCell(const Eigen::Vector2d& p) { return squareKey(p, kSeenCell); }

}  // namespace

double Hypothesis::total() const {
  return std::accumulate(evidence.begin(), evidence.end(), prior);
}

GlobalLocalisation::GlobalLocalisation(const PlanLines& plan)
    : plan_(plan), pyramid_(pyramidOf(plan)) {}

void GlobalLocalisation::begin(const std::optional<SearchWindow>& window) {
  window_ = window;
  expectation_.reset();
  expected_evidence_ = 0.0;
  expected_seen_ = {};
  views_.clear();
  seen_.clear();
  search_.reset();
  searched_ = false;
  candidates_.clear();
  hypotheses_.clear();
}

std::optional<PoseBelief> GlobalLocalisation::add(const ScanSurface& surface,
                                                  const Pose2& T_wheels_sensor,
                                                  const SightModel& model,
                                                  const LocalisationEffort& effort) {
  if (plan_.empty() || surface.points.empty()) return std::nullopt;
  matches_ = 0;
  if (isNewView(T_wheels_sensor)) {
    addView(surface, T_wheels_sensor);
    askExpected(model);
    for (Hypothesis& h : hypotheses_) {
      judgeAfter(views_.size() - 2, views_.size() - 1, model, h);
      h.prior = priorOf(h, model);
    }
    sortOut();
  }
  work(model, effort);
  return isSettled() || searched_ ? decided(T_wheels_sensor, model) : std::nullopt;
}

bool GlobalLocalisation::isNewView(const Pose2& T_wheels_sensor) const {
  if (views_.empty()) return true;
  const Pose2 step = views_.back().T_wheels_sensor.inverse() * T_wheels_sensor;
  return step.position().norm() >= kViewDistance || std::abs(step.theta) >= kViewTurn;
}

void GlobalLocalisation::addView(const ScanSurface& surface, const Pose2& T_wheels_sensor) {
  if (views_.size() == kMostViews) dropView();
  View view{surface, {}, T_wheels_sensor};
  std::vector<std::int64_t> cells;
  for (const SightRay& ray : sightRays(surface)) {
    const std::int64_t cell = seenCell(T_wheels_sensor * ray.end);
    if (seen_.count(cell) > 0) continue;
    cells.push_back(cell);
    view.rays.push_back(ray);
  }
  seen_.insert(cells.begin(), cells.end());
  views_.push_back(std::move(view));
}

/// The first one that is not being searched for. What it has seen stays seen: else a robot that
/// turns on the spot would count it again and again.
void GlobalLocalisation::dropView() {
  const bool is_searching = search_ || !candidates_.empty();
  const std::ptrdiff_t dropped = is_searching && searching_ == 0 ? 1 : 0;
  views_.erase(views_.begin() + dropped);
  for (Hypothesis& h : hypotheses_) {
    h.evidence[1 - static_cast<std::size_t>(dropped)] +=
        h.evidence[static_cast<std::size_t>(dropped)];
    h.evidence.erase(h.evidence.begin() + dropped);
  }
  if (searching_ > 0) --searching_;
}

void GlobalLocalisation::work(const SightModel& model, const LocalisationEffort& effort) {
  int cells = effort.cells;
  if (!search_ && candidates_.empty() && (!searched_ || searching_ + 1 < views_.size())) {
    beginSearch();
  }
  if (search_) {
    if (!search_->advance(cells)) return;
    for (const SearchResult& found : search_->several()) candidates_.push_back(found.T_map_query);
    std::reverse(candidates_.begin(), candidates_.end());
    search_.reset();
    searched_ = searched_ || candidates_.empty();
  }
  while (!candidates_.empty() && matches_ < effort.matches) {
    const Pose2 next = candidates_.back();
    candidates_.pop_back();
    auto hypothesis = judgedByAll(searching_, next, model);
    if (hypothesis) hypotheses_.push_back(std::move(*hypothesis));
    searched_ = searched_ || candidates_.empty();
  }
  sortOut();
}

std::optional<Pose2> GlobalLocalisation::bestIn(const SearchWindow& window,
                                                const ScanSurface& surface) const {
  const auto found = searchPose(queryOf(surface), pyramid_, window, kLeastFit);
  if (!found) return std::nullopt;
  return found->T_map_query;
}

void GlobalLocalisation::beginSearch() {
  searching_ = views_.size() - 1;
  SearchWindow window;
  const Eigen::Vector2d centre = plan_.bounds().center();
  window.centre = {centre.x(), centre.y(), 0.0};
  window.half_width = 0.5 * plan_.bounds().sizes().maxCoeff();
  window.half_turn = M_PI;
  if (window_) {
    window = *window_;
    window.centre =
        window.centre * (views_.front().T_wheels_sensor.inverse() * views_.back().T_wheels_sensor);
  }
  search_.emplace(queryOf(views_.back().surface), pyramid_, window, kLeastFit);
  search_->keepSeveral(kMostCandidates, kCandidateDistance, kCandidateTurn);
}

/// Matches a hypothesis to a view, and adds what that says of it.
void GlobalLocalisation::judge(const View& view, const Pose2& start, const PoseBelief& prior,
                               double reach, const SightModel& model, Hypothesis& hypothesis) {
  PlanMatching how;
  how.first_reach = reach;
  const PlanMatch match = matchPlan(view.surface, start, prior, plan_, how);
  ++matches_;
  hypothesis.T_map_sensor = match.T_map_sensor;
  hypothesis.information = match.information;
  const double tolerance = sightTolerance(view.surface.range_sigma);
  const SightShares seen = seePlan(view.rays, match.T_map_sensor, plan_, tolerance);
  const double sigma = std::hypot(kPlanNoise, view.surface.range_sigma);
  hypothesis.evidence.push_back(kOwnWord * seen.count() * model.evidence(seen, sigma, tolerance));
  hypothesis.seen += seen;
}

/// Takes it along from one view to a later one.
void GlobalLocalisation::judgeAfter(std::size_t from, std::size_t to, const SightModel& model,
                                    Hypothesis& hypothesis) {
  for (std::size_t k = from; k < to; ++k) {
    const Pose2 step = views_[k].T_wheels_sensor.inverse() * views_[k + 1].T_wheels_sensor;
    const PoseBelief prior = beliefAfter(hypothesis.T_map_sensor, step);
    judge(views_[k + 1], prior.mean, prior, kCoarse, model, hypothesis);
  }
}

/// Whether a place is hopeless by what some views say of it: the best one explains these so much
/// better that the others will hardly make up for it.
bool GlobalLocalisation::isBehind(const Hypothesis& hypothesis, std::size_t first) const {
  if (hypothesis.total() < kHopeless) return true;
  if (hypotheses_.empty()) return false;
  const auto from = hypotheses_.front().evidence.begin() + static_cast<std::ptrdiff_t>(first);
  const auto to = from + static_cast<std::ptrdiff_t>(hypothesis.evidence.size());
  return hypothesis.total() < std::accumulate(from, to, -kBehindBest);
}

/// A place where the sensor may have been at one view, asked of all views; nothing where it is
/// hopeless.
std::optional<Hypothesis> GlobalLocalisation::judgedByAll(std::size_t at, const Pose2& T_map_sensor,
                                                          const SightModel& model) {
  Hypothesis there;
  judge(views_[at], T_map_sensor, beliefOf(T_map_sensor, kCandidateSigma, kCandidateTurnSigma),
        kCoarse, model, there);
  if (isBehind(there, at)) return std::nullopt;
  Hypothesis earlier = there;
  for (std::size_t k = at; k > 0; --k) {
    const Pose2 step = views_[k].T_wheels_sensor.inverse() * views_[k - 1].T_wheels_sensor;
    const PoseBelief prior = beliefAfter(earlier.T_map_sensor, step);
    judge(views_[k - 1], prior.mean, prior, kCoarse, model, earlier);
    if (isBehind(earlier, k - 1)) return std::nullopt;
  }
  std::reverse(earlier.evidence.begin(), earlier.evidence.end());
  there.seen = earlier.seen;
  there.evidence = std::move(earlier.evidence);
  judgeAfter(at, views_.size() - 1, model, there);
  there.prior = priorOf(there, model);
  return there;
}

/// What a room that looks like another one would explain, where the robot must have been carried.
double GlobalLocalisation::priorOf(const Hypothesis& hypothesis, const SightModel& model) const {
  if (!expectation_) return 0.0;
  const View& last = views_.back();
  const Eigen::Vector3d off =
      difference(hypothesis.T_map_sensor, expectation_->T_map_wheels * last.T_wheels_sensor);
  if (off.head<2>().norm() < expectation_->reach && std::abs(off.z()) < expectation_->turn)
    return 0.0;
  const double sigma = std::hypot(kPlanNoise, last.surface.range_sigma);
  SightShares room = model.usual();
  // Nothing that was seen speaks against the wheels' place: the plan may not go on there.
  if (expected_seen_.agreement() >= kLeastAgreement) room = {1.0, 0.0, 0.0, 0.0, 0.0};
  room.distance_sq = room.explained * sigma * sigma;
  const double tolerance = sightTolerance(last.surface.range_sigma);
  return -kOwnWord * kRoomRays * std::max(0.0, model.evidence(room, sigma, tolerance));
}

/// Along a corridor the place beside the right one fits nearly as well, and the search keeps one of
/// both: those to either side of the best one, along its weakest direction, are asked as well.
void GlobalLocalisation::askNeighbours(const SightModel& model) {
  const Hypothesis best = hypotheses_.front();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(best.information.topLeftCorner<2, 2>());
  const Eigen::Vector2d weakest = axes.eigenvectors().col(0);
  for (int k = -kNeighbourSteps; k <= kNeighbourSteps; ++k) {
    if (k == 0) continue;
    Pose2 beside = best.T_map_sensor;
    beside.x += k * kNeighbourStep * weakest.x();
    beside.y += k * kNeighbourStep * weakest.y();
    auto neighbour = judgedByAll(views_.size() - 1, beside, model);
    if (neighbour) hypotheses_.push_back(std::move(*neighbour));
  }
  sortOut();
}

/// The most likely first; those in one place are one; what is hopeless goes.
void GlobalLocalisation::sortOut() {
  std::stable_sort(hypotheses_.begin(), hypotheses_.end(),
                   [](const auto& a, const auto& b) { return a.total() > b.total(); });
  std::vector<Hypothesis> kept;
  for (Hypothesis& h : hypotheses_) {
    if (kept.size() == kMostHypotheses) break;
    if (!kept.empty() && h.total() < kept.front().total() - kBehindBest) break;
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return isSamePlace(h.T_map_sensor, other.T_map_sensor);
    });
    if (!is_known) kept.push_back(std::move(h));
  }
  hypotheses_ = std::move(kept);
}

/// What the last view says of the place that the wheels lead to: at worst nothing, since the plan
/// may not go on there.
void GlobalLocalisation::askExpected(const SightModel& model) {
  if (!expectation_) return;
  const View& last = views_.back();
  const Pose2 there = expectation_->T_map_wheels * last.T_wheels_sensor;
  Hypothesis expected;
  judge(last, there, beliefOf(there, expectation_->reach, expectation_->turn), kCoarse, model,
        expected);
  expected_evidence_ += std::max(0.0, expected.total());
  expected_seen_ += expected.seen;
}

bool GlobalLocalisation::standsAlone() const {
  if (hypotheses_.empty()) return false;
  const Hypothesis& best = hypotheses_.front();
  double rival = hypotheses_.size() > 1 ? std::max(0.0, hypotheses_[1].total()) : 0.0;
  if (best.prior < 0.0) rival = std::max(rival, expected_evidence_);
  return best.total() >= rival + kClear && best.seen.agreement() >= kLeastAgreement &&
         best.seen.explained >= kLeastExplained * best.seen.count();
}

std::optional<PoseBelief> GlobalLocalisation::decided(const Pose2& T_wheels_sensor,
                                                      const SightModel& model) {
  if (!standsAlone()) return std::nullopt;
  askNeighbours(model);
  if (!standsAlone()) return std::nullopt;
  const Pose2 since = views_.back().T_wheels_sensor.inverse() * T_wheels_sensor;
  return beliefAfter(hypotheses_.front().T_map_sensor, since);
}

}  // namespace cca
