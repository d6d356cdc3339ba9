// SPDX-License-Identifier: BSD-3-Clause
#include "mount_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr std::size_t kLeastSteps = 10;
constexpr int kRounds = 20;
constexpr double kRidge = 1e-9;
/// m, rad: steps as long as these are told by scans and wheels well; shorter ones are joined.
constexpr double kStepWay = 0.1, kStepTurn = 0.15;

struct Step {
  Eigen::Vector2d scans, wheels;  ///< m, in the frame of the robot before
  Eigen::Matrix2d swing;          ///< R - I: by it a wrong place seems to move
};

std::vector<Step> stepsOf(const std::vector<Pose2>& by_scans, const std::vector<Pose2>& by_wheels) {
  std::vector<Step> steps;
  std::size_t from = 0;
  for (std::size_t k = 1; k < std::min(by_scans.size(), by_wheels.size()); ++k) {
    const Pose2 scans = by_scans[from].inverse() * by_scans[k];
    const Pose2 wheels = by_wheels[from].inverse() * by_wheels[k];
    if (scans.position().norm() < kStepWay && std::abs(scans.theta) < kStepTurn) continue;
    const double c = std::cos(scans.theta), s = std::sin(scans.theta);
    Step step{scans.position(), wheels.position(), Eigen::Matrix2d::Zero()};
    step.swing << c - 1.0, -s, s, c - 1.0;
    steps.push_back(step);
    from = k;
  }
  return steps;
}

}  // namespace

// With Y = T_true_told and the robot's motion (R, a): what the scans make of it is Y^-1 (R, a) Y,
// whose translation is R_Y^T (a + (R - I) y).
std::optional<MountError> mountError(const std::vector<Pose2>& by_scans,
                                     const std::vector<Pose2>& by_wheels) {
  const std::vector<Step> steps = stepsOf(by_scans, by_wheels);
  if (steps.size() < kLeastSteps) return std::nullopt;
  Eigen::Vector2d y(0, 0);
  double turn = 0.0, scale = 1.0;
  Eigen::Matrix2d N = Eigen::Matrix2d::Zero();
  double way = 0.0, rest = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    double along = 0.0, across = 0.0, scans_way = 0.0;
    way = rest = 0.0;
    for (const Step& s : steps) {
      const Eigen::Vector2d moved = scale * s.wheels + s.swing * y;
      along += s.scans.dot(moved);
      across += s.scans.x() * moved.y() - s.scans.y() * moved.x();
    }
    turn = std::atan2(across, along);
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn).toRotationMatrix();
    N = kRidge * Eigen::Matrix2d::Identity();
    Eigen::Vector2d b(0, 0);
    for (const Step& s : steps) {
      N += s.swing.transpose() * s.swing;
      b += s.swing.transpose() * (R * s.scans - scale * s.wheels);
    }
    y = N.inverse() * b;
    for (const Step& s : steps) {
      scans_way += s.wheels.dot(R * s.scans - s.swing * y);
      way += s.wheels.squaredNorm();
      rest += (R * s.scans - s.swing * y - scale * s.wheels).squaredNorm();
    }
    if (way > kRidge) scale = scans_way / way;
  }
  const double variance = rest / (2.0 * static_cast<double>(steps.size()));
  MountError error;
  error.T_true_told = {y.x(), y.y(), turn};
  error.sigma = std::sqrt(variance * N.inverse().trace());
  if (way > kRidge) error.turn_sigma = std::sqrt(variance / way);
  return error;
}

}  // namespace cca
