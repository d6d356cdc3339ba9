// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/scan_surface.hpp"

namespace cca {

/// A surface in a common frame, which is called the map here.
struct PlacedSurface {
  const ScanSurface* surface = nullptr;
  Pose2 T_map_sensor;
};

/// A Gaussian belief about a pose: (x, y) in the map frame, theta.
struct PoseBelief {
  Pose2 mean;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< 1/m^2, 1/(m rad), 1/rad^2
};

/// 99.7 % of a prior lies within.
inline constexpr double kPriorSigmas = 3.0;
/// Degrees of freedom of a prior about a pose: Student's t, for wheels slip now and then.
inline constexpr double kPriorFreedom = 4.0;

/// The quadratic form of the point-to-line distances of one surface on others, about a pose:
/// cost(step) = step' H step / 2 + g' step, step = (dx, dy, dtheta) in the map's axes, turning
/// about the sensor.
struct MatchQuadric {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  int paired = 0;            ///< returns that have a partner
  double sum_weights = 0.0;  ///< of them, each at most 1
  double sum_sq = 0.0;       ///< m^2, weighted squared distances
};

/// How far a return may lie from its partner, and what distance is usual.
struct MatchScale {
  double reach = 0.3;   ///< m
  double sigma = 0.05;  ///< m, of the robust (Cauchy) kernel
  int stride = 1;       ///< one in so many returns of the query is asked, and counts as so many
};

// A match to scans, and one to a plan: the reach shrinks a round, and so does the kernel.
inline constexpr double kShrinkReach = 0.7;
/// m, the first, where the start is about right: the least window of a search and a half of it.
inline constexpr double kFirstMatchReach = 0.3;
/// m, the finest; a wall is not to be taken for its other face, nor what leans on it for a wall.
inline constexpr double kFinestReach = 0.1;
/// Of the kernel; what is beyond is of another wall.
inline constexpr double kReachPerSigma = 4.0;
/// Four shrink 0.3 m to the finest, six 0.6 m; the rest settle.
inline constexpr int kMostMatchRounds = 12;
/// m, a usual distance of walls: a turn counts as it moves what is seen there.
inline constexpr double kTurnArm = 3.0;
/// m, a tenth of what a match is worth: what moves by less finds the same partners.
inline constexpr double kSettled = 5e-4;

/// Of the last steps of a match.
MatchScale finestScale(const ScanSurface& query);

/// By how much less the returns of a surface err than the kernel of a match lets pass, [0.1, 1].
double noiseShare(const ScanSurface& surface, const MatchScale& scale);

/// The stride of a match that will be followed by a finer one: some ninety returns are asked.
int coarseStride(const ScanSurface& query);

/// Each return of `query` finds, in each reference, the nearest return among the beams that look
/// that way, which must face the same way: the distance is measured along that one's normal.
/// Neighbouring returns err alike: a return is worth kIndependent of one of its own.
/// Cost: O(returns x references).
MatchQuadric matchQuadric(const ScanSurface& query, const Pose2& T_map_query,
                          const std::vector<PlacedSurface>& references, const MatchScale& scale);
/// Some ten neighbours lie on one piece of wall, and share its roughness and the error of its
/// normal.
inline constexpr double kIndependent = 0.1;

/// The same of a scan that was swept: of its pose in the middle of the sweep, and of the sensor's
/// motion in the halves before and after that, beyond the one that was undone: (dx, dy, dtheta)
/// each.
struct SweepQuadric {
  Eigen::Matrix<double, 9, 9> H = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> g = Eigen::Matrix<double, 9, 1>::Zero();
  int paired = 0;
};

/// By how much of the motion in either half of a sweep each return was seen from elsewhere than
/// from the middle. Constant acceleration.
struct SweepShares {
  std::vector<float> before, after;
};

SweepQuadric sweepQuadric(const PackedPoints& query, const SweepShares& shares,
                          const Pose2& T_map_query, const std::vector<PlacedSurface>& references,
                          const MatchScale& scale);

struct MatchResult {
  Pose2 T_map_query;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the match alone, map axes
  Eigen::Matrix3d posterior = Eigen::Matrix3d::Zero();    ///< information with the prior
  double sigma = 0.0;                                     ///< m, deviation of the paired returns
  double paired = 0.0;  ///< share of the query's returns that found a partner at the end
};

/// Gauss-Newton on these distances, the reach shrinking to what the noise needs.
/// @param prior  held to by its information; zero: not at all.
MatchResult matchSurface(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                         const std::vector<PlacedSurface>& references, double first_reach);

/// What the rays of a surface say of another's returns.
struct SightCount {
  double agree = 0.0;       ///< stands where this one, too, had a return
  double contradict = 0.0;  ///< stands where this one saw through
  double unseen = 0.0;      ///< behind what this one saw, or outside of its view
  SightCount& operator+=(const SightCount& other);
  /// agree / (agree + contradict); 0 where both are.
  double agreement() const;
};

/// A ray ends at a return within 20 cm of it. @param T_viewer_other  pose of the other's sensor in
/// the viewer's frame.
SightCount compareSights(const ScanSurface& viewer, const ScanSurface& other,
                         const Pose2& T_viewer_other);

/// Takes the surface, and with it all say in matches, from returns that more of the others saw
/// through than saw: people, doors. Cost: O(returns x others).
void forgetWhatMoved(ScanSurface& surface, const Pose2& T_map_sensor,
                     const std::vector<PlacedSurface>& others);

}  // namespace cca
