// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/trajectory_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "cca_mrpt/mapping/cross.hpp"

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

}  // namespace cca
