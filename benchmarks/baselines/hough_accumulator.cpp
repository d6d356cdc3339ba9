// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_accumulator.hpp"

#include <algorithm>
#include <cmath>

namespace cca::baselines {

HoughAccumulator::HoughAccumulator(const HoughResolution& resolution, double reach)
    : distance_step_(resolution.distance), reach_(reach) {
  const auto angles = static_cast<Eigen::Index>(std::lround(180.0 / resolution.angle_deg));
  const auto distances = static_cast<Eigen::Index>(std::ceil(2.0 * reach / distance_step_)) + 1;
  const Eigen::ArrayXd alpha =
      Eigen::ArrayXd::LinSpaced(angles, 0.0, M_PI * (1.0 - 1.0 / static_cast<double>(angles)));
  cosines_ = alpha.cos();
  sines_ = alpha.sin();
  votes_.setZero(distances, angles);
}

void HoughAccumulator::vote(const Eigen::Vector2d& point, int weight) {
  for (Eigen::Index a = 0; a < votes_.cols(); ++a) {
    const double r = point.x() * cosines_[a] + point.y() * sines_[a];
    const auto cell = static_cast<Eigen::Index>((r + reach_) / distance_step_);
    short& votes = votes_(std::clamp<Eigen::Index>(cell, 0, votes_.rows() - 1), a);
    votes = static_cast<short>(votes + weight);
  }
}

HoughAccumulator::Peak HoughAccumulator::strongest() const {
  Peak peak;
  short most = 0;
  Eigen::Index best_cell = 0, best_angle = 0;
  for (Eigen::Index a = 0; a < votes_.cols(); ++a) {
    const short column_most = votes_.col(a).maxCoeff();
    if (column_most > most) most = column_most, best_angle = a;
  }
  votes_.col(best_angle).maxCoeff(&best_cell);
  const Eigen::Vector2d normal(cosines_[best_angle], sines_[best_angle]);
  const double r = (static_cast<double>(best_cell) + 0.5) * distance_step_ - reach_;
  peak.votes = most;
  peak.line.centroid = r * normal;
  peak.line.direction = {-normal.y(), normal.x()};
  return peak;
}

}  // namespace cca::baselines
