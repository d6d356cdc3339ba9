// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/fitted_circle.hpp"

#include <Eigen/LU>
#include <cmath>

namespace cca::baselines {

std::optional<FittedCircle> fitCircle(const Points& points, Run run) {
  if (run.size() < 3) return std::nullopt;
  const Eigen::Vector2d mean = momentsOf(points, run).mean;
  // About the mean the sums of x and y vanish: the centre follows from moments alone.
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = run.first; i < run.last; ++i) {
    const Eigen::Vector2d p = points[i] - mean;
    spread += p * p.transpose();
    moment += 0.5 * p.squaredNorm() * p;
  }
  constexpr double kStraight =
      1e-12;  // as many digits as squares of doubles leave: a millionth of its length
  if (spread.determinant() <= kStraight * spread.trace() * spread.trace()) return std::nullopt;
  const Eigen::Vector2d centre = spread.inverse() * moment;
  const double radius_sq = spread.trace() / static_cast<double>(run.size()) + centre.squaredNorm();
  if (!(radius_sq > 0.0) || !std::isfinite(radius_sq)) return std::nullopt;
  FittedCircle circle{mean + centre, std::sqrt(radius_sq), 0.0};
  for (std::size_t i = run.first; i < run.last; ++i) {
    const double off = (points[i] - circle.centre).norm() - circle.radius;
    circle.residual_sum_sq += off * off;
  }
  return circle;
}

bool isRound(const Points& points, Run run, double largest_radius) {
  const std::optional<FittedCircle> circle = fitCircle(points, run);
  return circle && circle->radius <= largest_radius &&
         circle->residual_sum_sq <= 0.5 * fitLine(momentsOf(points, run)).residual_sum_sq;
}

}  // namespace cca::baselines
