// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/kalman_grouping.hpp"

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "baselines/fitted_circle.hpp"

namespace cca::baselines {
namespace {

/// Inverse ranges at this beam and the one before, of a plane.
class PlaneFilter {
 public:
  PlaneFilter(double range_before, double range, double noise)
      : noise_(noise), state_(1.0 / range, 1.0 / range_before) {
    covariance_.diagonal() << variance(range), variance(range_before);
  }

  void predict(double spacing) {
    Eigen::Matrix2d step;
    step << 2.0 * std::cos(spacing), -1.0, 1.0, 0.0;
    state_ = step * state_;
    covariance_ = step * covariance_ * step.transpose();
  }

  /// @return  squared innovation, in variances.
  double update(double range) {
    const double off = 1.0 / range - state_.x();
    const double sum = covariance_(0, 0) + variance(range);
    const Eigen::Vector2d gain = covariance_.col(0) / sum;
    state_ += gain * off;
    covariance_ -= gain * covariance_.row(0).eval();
    return off * off / sum;
  }

 private:
  double variance(double range) const {
    const double sigma = noise_ / (range * range);
    return sigma * sigma;
  }
  double noise_;
  Eigen::Vector2d state_;
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();
};

/// Returns of neighbouring beams that follow planes.
std::vector<Run> groups(const Scan& scan, const KalmanGroupingParameters& p) {
  std::vector<Run> runs;
  std::optional<PlaneFilter> filter;
  double before = 0.0;  // m, range of the beam before; 0: no return
  std::size_t point = 0;
  for (const double range : scan.ranges) {
    if (!isReturn(range)) {
      before = 0.0;
      filter.reset();
      continue;
    }
    bool goes_on = before > 0.0;
    if (filter) {
      filter->predict(scan.angle_increment);
      goes_on = filter->update(range) <= p.gate;
    }
    if (!goes_on) {
      filter.reset();
      runs.push_back({point, point});
    } else if (!filter) {
      filter.emplace(before, range, p.range_noise);
    }
    runs.back().last = ++point;
    before = range;
  }
  return runs;
}

void split(const Points& points, Run run, const KalmanGroupingParameters& p,
           std::vector<Run>& out) {
  if (isRound(points, run, p.largest_radius)) return;
  if (run.size() > 2) {
    const std::size_t cut = farthestFromChord(points, run);
    if (distanceFrom(fitLine(momentsOf(points, run)), points[cut]) > p.tolerance) {
      split(points, {run.first, cut}, p, out);
      split(points, {cut, run.last}, p, out);
      return;
    }
  }
  out.push_back(run);
}

}  // namespace

KalmanGroupingParameters KalmanGroupingParameters::tuned() {
  return {{5, 0.29}, 0.025, 16.0, 0.30, 0.27};
}

std::vector<LineSegment> kalmanGrouping(const Scan& scan, const KalmanGroupingParameters& p) {
  const Points points = returnedPoints(scan);
  std::vector<Run> edges;
  for (const Run& run : groups(scan, p)) split(points, run, p, edges);
  return segmentsOf(points, edges, p.limits);
}

}  // namespace cca::baselines
