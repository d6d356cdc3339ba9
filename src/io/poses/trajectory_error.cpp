// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/trajectory_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geometry/cross.hpp"

namespace cca {
namespace {

/// The rigid motion that brings the estimate closest to the truth, in the least squares of the
/// positions [Horn 1987, in the plane].
Pose2 bestMotion(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth) {
  Eigen::Vector2d mean_e = Eigen::Vector2d::Zero(), mean_t = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < truth.size(); ++k) {
    mean_e += estimate[k].position();
    mean_t += truth[k].position();
  }
  mean_e /= static_cast<double>(truth.size());
  mean_t /= static_cast<double>(truth.size());
  double along = 0.0, across = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const Eigen::Vector2d e = estimate[k].position() - mean_e, t = truth[k].position() - mean_t;
    along += e.dot(t);
    across += cross(e, t);
  }
  Pose2 motion{0.0, 0.0, along == 0.0 && across == 0.0 ? 0.0 : std::atan2(across, along)};
  const Eigen::Vector2d shift = mean_t - motion * mean_e;
  motion.x = shift.x();
  motion.y = shift.y();
  return motion;
}

}  // namespace

TrajectoryError compareTrajectories(const std::vector<Pose2>& estimate,
                                    const std::vector<Pose2>& truth) {
  assert(estimate.size() == truth.size());
  TrajectoryError error;
  if (truth.empty()) return error;
  const Pose2 motion = bestMotion(estimate, truth);
  double sum_sq_m = 0.0, sum_sq_rad = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const Pose2 moved = motion * estimate[k];
    const double distance = (moved.position() - truth[k].position()).norm();
    const double turn = wrapAngle(moved.theta - truth[k].theta);
    error.max_m = std::max(error.max_m, distance);
    sum_sq_m += distance * distance;
    sum_sq_rad += turn * turn;
  }
  const auto count = static_cast<double>(truth.size());
  error.rms_m = std::sqrt(sum_sq_m / count);
  error.rms_deg = std::sqrt(sum_sq_rad / count) * 180.0 / M_PI;
  error.at_end_m = (estimate.back().position() - truth.back().position()).norm();
  return error;
}

double loopError(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth) {
  assert(estimate.size() == truth.size());
  constexpr double kNear = 3.0, kApart = 30.0;  // m
  constexpr std::size_t kVisits = 2000;
  std::vector<double> way(truth.size(), 0.0);
  for (std::size_t k = 1; k < truth.size(); ++k) {
    way[k] = way[k - 1] + (truth[k].position() - truth[k - 1].position()).norm();
  }
  const std::size_t step = truth.size() / kVisits + 1;
  double sum = 0.0;
  std::size_t pairs = 0;
  for (std::size_t a = 0; a < truth.size(); a += step) {
    for (std::size_t b = a + 1; b < truth.size(); b += step) {
      if (way[b] - way[a] <= kApart) continue;
      const Pose2 T_true = truth[a].inverse() * truth[b];
      if (T_true.position().norm() >= kNear) continue;
      const Pose2 T_estimated = estimate[a].inverse() * estimate[b];
      sum += (T_true.inverse() * T_estimated).position().norm();
      ++pairs;
    }
  }
  return pairs > 0 ? sum / static_cast<double>(pairs) : 0.0;
}

}  // namespace cca
