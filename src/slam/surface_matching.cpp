// SPDX-License-Identifier: BSD-3-Clause
#include "slam/surface_matching.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// A step of less than this share of the reach finds the partners of the finest one at once.
constexpr double kNear = 0.1;
constexpr double kSettledTurn = 1e-4;  // rad; a tenth of what a match is worth
/// Of the kernel's sigma, at least: the walls themselves are no better.
constexpr double kLeastNoise = 0.1;

MatchScale scaleOf(double reach) { return {reach, reach / kReachPerSigma}; }

}  // namespace

MatchScale finestScale(const ScanSurface& query) {
  return scaleOf(std::max(kFinestReach, kReachPerSigma * query.range_sigma));
}

double noiseShare(const ScanSurface& surface, const MatchScale& scale) {
  return std::clamp(surface.range_sigma / scale.sigma, kLeastNoise, 1.0);
}

int coarseStride(const ScanSurface& query) {
  constexpr int kCoarseReturns = 90;  // evenly over the scan: two degrees apart
  return std::max(1, static_cast<int>(query.points.size()) / kCoarseReturns);
}

MatchResult matchSurface(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                         const std::vector<PlacedSurface>& references, double first_reach) {
  MatchResult result;
  result.T_map_query = start;
  MatchScale scale = scaleOf(first_reach);
  const double least = finestScale(query).reach;
  for (int round = 0; round < kMostMatchRounds; ++round) {
    scale.stride = scale.reach > least ? coarseStride(query) : 1;
    const MatchQuadric quadric = matchQuadric(query, result.T_map_query, references, scale);
    const Eigen::Vector3d off = difference(result.T_map_query, prior.mean);
    const double off_sq = off.dot(prior.information * off);
    const Eigen::Matrix3d held = prior.information / (1.0 + off_sq / kPriorFreedom);
    result.information = quadric.H;
    // As far off as is to be expected the prior is known as well as before: else, where the match
    // says nothing, it would be forgotten by and by.
    result.posterior = quadric.H + prior.information * std::min(1.0, (kPriorFreedom + 3.0) /
                                                                         (kPriorFreedom + off_sq));
    result.paired = query.points.empty() ? 0.0
                                         : static_cast<double>(quadric.paired) /
                                               static_cast<double>(query.points.size());
    if (quadric.sum_weights > 0.0) result.sigma = std::sqrt(quadric.sum_sq / quadric.sum_weights);
    const Eigen::LDLT<Eigen::Matrix3d> solver(Eigen::Matrix3d(quadric.H + held));
    if (quadric.paired == 0 || solver.info() != Eigen::Success || !solver.isPositive()) break;
    const Eigen::Vector3d step = solver.solve(-(quadric.g + held * off));
    if (!step.allFinite()) break;
    result.T_map_query.x += step.x();
    result.T_map_query.y += step.y();
    result.T_map_query.theta = wrapAngle(result.T_map_query.theta + step.z());
    const bool is_finest = scale.reach <= least;
    if (is_finest && step.head<2>().norm() < kSettled && std::abs(step.z()) < kSettledTurn) break;
    const bool is_near =
        step.head<2>().norm() + kTurnArm * std::abs(step.z()) < kNear * scale.reach;
    scale = scaleOf(is_near ? least : std::max(least, kShrinkReach * scale.reach));
  }
  return result;
}

}  // namespace cca
