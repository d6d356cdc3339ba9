// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/fitted_circle.hpp"

#include <Eigen/QR>
#include <cmath>

namespace cca::baselines {

std::optional<FittedCircle> fitCircle(const Points& points, Run run) {
  if (run.size() < 3) return std::nullopt;
  const Eigen::Vector2d mean = momentsOf(points, run).mean;
  Eigen::MatrixX3d terms(run.size(), 3);
  Eigen::VectorXd squares(run.size());
  for (std::size_t i = run.first; i < run.last; ++i) {
    const Eigen::Vector2d p = points[i] - mean;
    const auto row = static_cast<Eigen::Index>(i - run.first);
    terms.row(row) << 2.0 * p.x(), 2.0 * p.y(), 1.0;
    squares(row) = p.squaredNorm();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> solver(terms);
  if (solver.rank() < 3) return std::nullopt;
  const Eigen::Vector3d solution = solver.solve(squares);
  const double radius_sq = solution.z() + solution.head<2>().squaredNorm();
  if (!(radius_sq > 0.0) || !std::isfinite(radius_sq)) return std::nullopt;
  FittedCircle circle{mean + solution.head<2>(), std::sqrt(radius_sq), 0.0};
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
