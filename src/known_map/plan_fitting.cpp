// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_fitting.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace cca {
namespace {

/// nats a beam, below which a scan is in doubt; and of what is usual here: where the plan explains
/// nearly all, a scan of which it explains half is from elsewhere.
constexpr double kDoubt = 0.1, kDoubtOfUsual = 0.5;
/// Shares, see isDoubtful(): in furnished rooms of ten plans the plan explains 58 to 67 % of a scan
/// and nothing goes through a wall; by chance it explains 25 %, and 30 % go through.
constexpr double kMostOfScan = 0.5, kUncontradicted = 0.95;
constexpr double kFewestRays = 8;     // that may put it there
constexpr double kBetterThere = 0.3;  // nats a beam, for a place found by a search
constexpr double kSearchHalfWidth = 1.0, kSearchHalfTurn = 0.8;  // m, rad: of a robot that slips

/// m: at first as of a plan that is drawn with care; at least what a pose errs by among true lines
/// (docs/localisation.md, .007 m); at most what a match's finest reach still pairs.
constexpr double kFirstPlanSigma = 0.02, kLeastPlanSigma = 0.007, kMostPlanSigma = 0.1;
constexpr double kLearnPlan = 0.03, kLearnSights = 0.05;  // of a scan that is all news

/// Squared deviations of a match from what was believed of the pose without it.
double offSquared(const PlanFit& fit, const PoseBelief& prior) {
  const Eigen::Vector3d off = difference(fit.match.T_map_sensor, prior.mean);
  return off.dot(prior.information * off);
}

/// nats, of a pose by its scan and by what was believed of it without.
double likelihood(const PlanFit& fit, const PoseBelief& prior) {
  return kOwnWord * fit.seen.count() * fit.evidence -
         0.5 * (kPriorFreedom + 3.0) * std::log1p(offSquared(fit, prior) / kPriorFreedom);
}

}  // namespace

PoseSpread spreadOf(const Eigen::Matrix3d& covariance) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(covariance.topLeftCorner<2, 2>(), Eigen::EigenvaluesOnly);
  return {std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff())), std::sqrt(covariance(2, 2))};
}

PlanFitting::PlanFitting(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas)
    : plan_(plan, sigmas),
      global_(plan_),
      doors_(plan_.pieces().size()),
      plan_sigma_(kFirstPlanSigma) {}

PlanFit PlanFitting::fitAt(const TakenScan& scan, const Pose2& start, const PoseBelief& prior,
                           double reach, double share) const {
  PlanMatching how;
  how.first_reach = reach;
  how.plan_sigma = plan_sigma_;
  how.share = share;
  how.scan_covariance = scan.covariance;
  PlanFit fit;
  fit.match = matchPlan(scan.surface, start, prior, plan_, how);
  fit.seen = seePlan(scan.rays, fit.match.T_map_sensor, plan_,
                     sightTolerance(scan.surface.range_sigma), doors_.isOpen(), &fit.said);
  fit.evidence = sights_.evidence(fit.seen);
  return fit;
}

double PlanFitting::doubt() const {
  return std::max(kDoubt, kDoubtOfUsual * sights_.evidence(sights_.usual()));
}
bool PlanFitting::isDoubtful(const PlanFit& fit) const {
  const double count = fit.seen.count();
  if (fit.evidence >= doubt() || count < kFewestRays) return false;
  return fit.evidence < kDoubt || fit.seen.explained < kMostOfScan * count ||
         fit.seen.agreement() < kUncontradicted;
}

bool PlanFitting::isRefuted(const PlanFit& fit) const {
  return isDoubtful(fit) && fit.evidence < kDoubt;
}

PlanFit PlanFitting::fitAbout(const TakenScan& scan, const PoseBelief& prior, double share) const {
  const PoseSpread spread = spreadOf(prior.information.inverse());
  const double span = kPriorSigmas * (spread.position + kTurnArm * spread.turn);
  const double reach = std::clamp(span, kLeastMatchReach, PlanLines::kMostReach);
  const auto bestWithin = [&](double half_width, double half_turn) {
    SearchWindow window;
    window.centre = prior.mean;
    window.half_width = std::min(half_width, kSearchHalfWidth);
    window.half_turn = half_turn;
    return global_.bestIn(window, scan.surface);
  };
  PlanFit here = fitAt(scan, prior.mean, prior, reach, share);
  if (offSquared(here, prior) > kPriorSigmas * kPriorSigmas) {
    PlanFit near = fitAt(scan, prior.mean, prior, kLeastMatchReach, share);
    if (likelihood(near, prior) > likelihood(here, prior)) here = std::move(near);
  }
  if (span > PlanLines::kMostReach) {
    const double turn = std::min(kPriorSigmas * spread.turn, kSearchHalfTurn);
    if (const auto elsewhere = bestWithin(kPriorSigmas * spread.position, turn)) {
      PlanFit there = fitAt(scan, *elsewhere, prior, kFirstMatchReach, share);
      if (likelihood(there, prior) > likelihood(here, prior)) here = std::move(there);
    }
  }
  if (!isDoubtful(here)) return here;
  // A scan that speaks against the place: wheels that slip lose any turn, and little way.
  const auto elsewhere = bestWithin(kSearchHalfWidth, here.evidence < 0.0 ? M_PI : kSearchHalfTurn);
  if (!elsewhere) return here;
  PoseBelief vague = prior;
  vague.information *= 0.01;
  const PlanFit there = fitAt(scan, *elsewhere, vague, PlanLines::kMostReach, 1.0);
  return there.evidence > std::max(doubt(), here.evidence) + kBetterThere ? there : here;
}

PlanFit PlanFitting::fitWithin(const TakenScan& scan, const PoseBelief& told) const {
  const PoseSpread spread = spreadOf(told.information.inverse());
  SearchWindow window;
  window.centre = told.mean;
  window.half_width = std::min(kPriorSigmas * spread.position, Expectation::kWidestReach);
  window.half_turn = std::min(kPriorSigmas * spread.turn, M_PI);
  PlanFit here = fitAt(scan, told.mean, told, PlanLines::kMostReach, 1.0);
  const auto elsewhere = global_.bestIn(window, scan.surface);
  if (!elsewhere) return here;
  PlanFit there = fitAt(scan, *elsewhere, told, PlanLines::kMostReach, 1.0);
  return there.evidence > here.evidence ? there : here;
}

void PlanFitting::learn(const PlanFit& fit, double share) {
  // What is usual is so in the plan: in a room that it has not, half of a scan may be in it.
  if (fit.evidence >= doubt()) sights_.learn(fit.seen, share * kLearnSights);
  if (fit.match.piece_variance >= 0.0) {
    const double variance = plan_sigma_ * plan_sigma_;
    const double learned = variance + share * kLearnPlan * (fit.match.piece_variance - variance);
    plan_sigma_ = std::clamp(std::sqrt(std::max(0.0, learned)), kLeastPlanSigma, kMostPlanSigma);
  }
  doors_.learn(fit.said, share);
}

}  // namespace cca
