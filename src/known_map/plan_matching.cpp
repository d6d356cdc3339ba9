// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_matching.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kStill = 2e-4, kStillTurn = 5e-5;  // m, rad: a tenth of what a match is worth
constexpr double kFewOnPiece = 5.0;                 // returns, for its mean distance to tell
/// A pose has three numbers, which leave the mean distances of three pieces nought.
constexpr int kFewPieces = 4;

/// Of the returns that lie on one piece.
struct PieceSums {
  PlanLines::Slot slot = -1;
  double sigma = 0.0;  ///< m, of its line, as the map tells it
  Eigen::Matrix3d JJ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d Je = Eigen::Vector3d::Zero(), J = Eigen::Vector3d::Zero();
  double weight = 0.0, e = 0.0, ee = 0.0;
};

/// cost(step) = step' H step / 2 + g' step, as of MatchQuadric.
struct PlanQuadric {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  int paired = 0;
  double weight = 0.0, ee = 0.0;
  double mean_sq = 0.0, noise_of_mean = 0.0;  ///< m^2, sums over pieces
  int pieces = 0;
  double offset_worth = 0.0, angle_worth = 0.0;  ///< m^-2, rad^-2, sums over returns

  /// Takes a piece's returns, which have the plan's error there in common: what is usual, or what
  /// the map says of a line that it knows less well, as of one that stands for both faces of a
  /// wall.
  void take(const PieceSums& s, double sigma, double plan_sigma) {
    if (s.weight <= 0.0) return;
    const double off = std::max(plan_sigma, s.sigma);
    const double unit = 1.0 / (sigma * sigma), common = off * off;
    const double taken = common / (sigma * sigma + s.weight * common);
    H += unit * (s.JJ - taken * s.J * s.J.transpose());
    g += unit * (s.Je - taken * s.J * s.e);
    weight += s.weight;
    ee += s.ee;
    if (s.weight < kFewOnPiece || s.sigma > plan_sigma) return;  // of what is usual
    ++pieces;
    const double mean = s.e / s.weight;
    mean_sq += mean * mean;
    noise_of_mean += std::max(0.0, s.ee / s.weight - mean * mean) / s.weight;
  }
};

/// What lines err by together is no more than the best known ones do: the harmonic mean, of which a
/// line that does not tell (infinite worth) makes nothing.
LineSigma mapSigma(const PlanQuadric& quadric) {
  if (quadric.weight <= 0.0) return {};
  return {std::sqrt(quadric.weight / quadric.offset_worth),
          std::sqrt(quadric.weight / quadric.angle_worth)};
}

/// What is left of a match's information by an error of the whole scan: (H^-1 + R)^-1, and the
/// gradient alike, also where H has no inverse.
void admitScanError(const Eigen::Matrix3d& covariance, PlanQuadric& quadric) {
  const Eigen::Matrix3d taken = quadric.H * (covariance.inverse() + quadric.H).inverse();
  quadric.g -= taken * quadric.g.eval();
  quadric.H -= taken * quadric.H.eval();
}

PlanQuadric planQuadric(const ScanSurface& surface, const Pose2& pose, const PlanLines& plan,
                        double reach, double sigma, double plan_sigma) {
  const double c = std::cos(pose.theta), s = std::sin(pose.theta);
  const double kernel = reach / kReachPerSigma;
  PlanQuadric quadric;
  PieceSums sums;
  for (const ScanSurface::Point& point : surface.points) {
    if (point.normal.isZero()) continue;
    const Eigen::Vector2d& q = point.position;
    const Eigen::Vector2d arm{c * q.x() - s * q.y(), s * q.x() + c * q.y()};
    const Eigen::Vector2d normal{c * point.normal.x() - s * point.normal.y(),
                                 s * point.normal.x() + c * point.normal.y()};
    const Eigen::Vector2d p = pose.position() + arm;
    const PlanLines::Slot slot = plan.nearest(p, normal, reach);
    if (slot < 0) continue;
    // Neighbouring beams meet the same piece: one run of them is one piece's, mostly.
    if (slot != sums.slot) {
      quadric.take(sums, sigma, plan_sigma);
      sums = {};
      sums.slot = slot;
      sums.sigma = plan[slot].sigma.offset;
    }
    const PlanLines::Piece& piece = plan[slot];
    const double e = cross(piece.direction, p - piece.start);
    const double weight = 1.0 / (1.0 + e * e / (kernel * kernel));
    const Eigen::Vector2d n = piece.normal();
    const Eigen::Vector3d J{n.x(), n.y(), cross(arm, n)};
    sums.JJ += weight * J * J.transpose();
    sums.Je += weight * e * J;
    sums.J += weight * J;
    sums.weight += weight;
    sums.e += weight * e;
    sums.ee += weight * e * e;
    quadric.offset_worth += weight / (piece.sigma.offset * piece.sigma.offset);
    quadric.angle_worth += weight / (piece.sigma.angle * piece.sigma.angle);
    ++quadric.paired;
  }
  quadric.take(sums, sigma, plan_sigma);
  return quadric;
}

}  // namespace

PlanMatch matchPlan(const ScanSurface& surface, const Pose2& start, const PoseBelief& prior,
                    const PlanLines& plan, const PlanMatching& how) {
  PlanMatch match;
  match.T_map_sensor = start;
  const double finest = std::max(kFinestReach, kReachPerSigma * surface.range_sigma);
  double reach = std::clamp(how.first_reach, finest, PlanLines::kMostReach);
  double sigma = std::max(surface.range_sigma, kFinestReach / kReachPerSigma);
  for (int round = 0; round < kMostMatchRounds; ++round) {
    PlanQuadric quadric =
        planQuadric(surface, match.T_map_sensor, plan, reach, sigma, how.plan_sigma);
    admitScanError(how.scan_covariance, quadric);
    const Eigen::Vector3d off = difference(match.T_map_sensor, prior.mean);
    const double off_sq = off.dot(prior.information * off);
    const Eigen::Matrix3d held = prior.information / (1.0 + off_sq / kPriorFreedom);
    match.information = quadric.H;
    match.posterior =
        how.share * quadric.H +
        prior.information * std::min(1.0, (kPriorFreedom + 3.0) / (kPriorFreedom + off_sq));
    const double points = static_cast<double>(surface.points.size());
    match.paired = points > 0.0 ? quadric.paired / points : 0.0;
    match.map_sigma = mapSigma(quadric);
    if (quadric.weight > 0.0) match.sigma = std::sqrt(quadric.ee / quadric.weight);
    if (quadric.pieces >= kFewPieces) {
      match.piece_variance = (quadric.mean_sq - quadric.noise_of_mean) / quadric.pieces;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(Eigen::Matrix3d(how.share * quadric.H + held));
    if (quadric.paired == 0 || solver.info() != Eigen::Success || !solver.isPositive()) break;
    const Eigen::Vector3d step = solver.solve(-(how.share * quadric.g + held * off));
    if (!step.allFinite()) break;
    match.T_map_sensor.x += step.x();
    match.T_map_sensor.y += step.y();
    match.T_map_sensor.theta = wrapAngle(match.T_map_sensor.theta + step.z());
    const bool is_finest = reach <= finest;
    if (is_finest && step.head<2>().norm() < kStill && std::abs(step.z()) < kStillTurn) break;
    reach = std::max(finest, kShrinkReach * reach);
    sigma = std::max(surface.range_sigma, std::min(sigma, std::max(match.sigma, 1e-3)));
  }
  return match;
}

}  // namespace cca
