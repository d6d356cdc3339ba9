// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/line_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

/// Returns that the mean of a full bin is worth: it forgets one in kMostHits at each new one.
constexpr double kMostWorth = 2.0 * SupportBin::kMostHits;

/// m, from the laser to the walls of a room of 4 m.
constexpr double kUsualDistance = 2.0;

double worthOf(const SupportBin& bin) {
  return bin.hits() < SupportBin::kMostHits ? bin.hits() : kMostWorth;
}

/// The bins of a piece, about its middle.
struct Fitted {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();  ///< sum of w (1, t)(1, t)'
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();   ///< the same of w^2 / returns
  double returns = 0.0, scatter = 0.0;               ///< number; m^2, their squared residuals
};

/// What is left of the bins' mean points, in deviations of what the ranges explain.
struct Residuals {
  double squares = 0.0, products = 0.0;  ///< of each with itself, and with the next one
  int bins = 0, pairs = 0;

  void add(double z, bool follows) {
    if (follows) {
      products += z * last;
      ++pairs;
    }
    squares += z * z;
    last = z;
    ++bins;
  }
  /// Factor of the variance, >= 1, by which bins are worth less than their number. Neither spread
  /// nor likeness can be below the least, so they are above it by chance: each counts from its own
  /// deviation, sqrt(2 / n) and 1 / sqrt(n) of n residuals without a bend.
  double inflation() const {
    constexpr double kMostAlike = 0.98;  // bins are worth a hundredth of their number at least
    constexpr int kFewest = 4;           // bins that tell a bend from noise
    if (bins < kFewest || pairs == 0 || squares <= 0.0) return 1.0;
    const double spread = std::max(1.0, squares / (bins - 2) - std::sqrt(2.0 / bins));
    const double alike = products / pairs / (squares / bins) - 1.0 / std::sqrt(pairs);
    const double rho = std::clamp(alike, 0.0, kMostAlike);
    return spread * (1.0 + rho) / (1.0 - rho);
  }
  double last = 0.0;
};

}  // namespace

Eigen::Matrix2d covarianceOf(const Wall& wall, const LineSegment& piece, const MapNoise& noise) {
  const Eigen::Vector2d a = wall.toWall(piece.start), b = wall.toWall(piece.end);
  const BinRange range{std::max(wall.profile.first(), SupportProfile::binOf(a.x())),
                       std::min(wall.profile.last(), SupportProfile::binOf(b.x()) + 1)};
  const double middle = 0.5 * (a.x() + b.x()), slope = (b.y() - a.y()) / (b.x() - a.x());
  const double offset = 0.5 * (a.y() + b.y());
  Fitted fitted;
  for (int i = range.first; i < range.last; ++i) {
    const SupportBin& bin = wall.profile.bin(i);
    if (bin.hits() <= 0.0) continue;
    const Eigen::Vector2d mean = bin.mean();
    const double t = mean.x() - middle, w = weightOf(bin), worth = worthOf(bin);
    Eigen::Matrix2d square;
    square << 1.0, t, t, t * t;
    fitted.normal += w * square;
    fitted.noise += w * w / worth * square;
    fitted.returns += bin.hits();
    const double off = mean.y() - offset - slope * t;
    const double within = std::max(0.0, bin.returns.yy - bin.hits() * mean.y() * mean.y());
    fitted.scatter += within + bin.hits() * off * off;
  }
  const double finest = kFinestSigma * kFinestSigma / 12.0;
  const double variance = std::max(finest, fitted.scatter / std::max(1.0, fitted.returns - 2.0));
  Residuals residuals;
  int before = range.first - 2;
  for (int i = range.first; i < range.last; ++i) {
    const SupportBin& bin = wall.profile.bin(i);
    if (bin.hits() <= 0.0) continue;
    const double off = bin.mean().y() - offset - slope * (bin.mean().x() - middle);
    residuals.add(off * std::sqrt(worthOf(bin) / variance), before == i - 1);
    before = i;
  }
  Eigen::Matrix2d covariance = Eigen::Vector2d(1.0, 1.0).asDiagonal();
  if (fitted.normal.determinant() > 1e-9) {
    const Eigen::Matrix2d inverse = fitted.normal.inverse();
    covariance = variance * residuals.inflation() * inverse * fitted.noise * inverse;
  }
  Eigen::Matrix2d carry = Eigen::Matrix2d::Identity();
  carry(0, 1) = middle - wall.known_at;
  covariance += carry * wall.pose_covariance * carry.transpose();
  const double behind = noise.rangeVariance() / (2.0 * kUsualDistance);
  double beside = behind * behind;
  if (wall.two_sided) beside += std::max(0.0, variance - noise.rangeVariance());
  covariance(0, 0) += beside;
  covariance(1, 1) += 2.0 * beside / piece.length() / piece.length();  // each end on its own
  const double visits = std::max(1.0, wall.visits);
  covariance(0, 0) += noise.ownOffsetVariance() / visits;
  covariance(1, 1) = std::min(1.0, covariance(1, 1) + noise.ownAngleVariance() / visits);
  return 0.5 * (covariance + covariance.transpose());
}

}  // namespace cca
