// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/point_sums.hpp"

#include <algorithm>

namespace cca {
namespace {

constexpr double kOnePlace = 1e-9;  // m^2, spread along x that gives no direction

}  // namespace

PointSums PointSums::moved(const Eigen::Vector2d& shift, double c, double s) const {
  const double x0 = shift.x(), y0 = shift.y(), x1 = c * x - s * y, y1 = s * x + c * y;
  PointSums m;
  m.w = w;
  m.x = w * x0 + x1;
  m.y = w * y0 + y1;
  m.xx = w * x0 * x0 + 2.0 * x0 * x1 + c * c * xx - 2.0 * c * s * xy + s * s * yy;
  m.yy = w * y0 * y0 + 2.0 * y0 * y1 + s * s * xx + 2.0 * s * c * xy + c * c * yy;
  m.xy = w * x0 * y0 + x0 * y1 + y0 * x1 + c * s * xx + (c * c - s * s) * xy - s * c * yy;
  return m;
}

LateralFit PointSums::fit() const {
  if (w <= 0.0) return {};
  const double s_xx = xx - x * x / w, s_xy = xy - x * y / w;
  const double slope = s_xx > kOnePlace ? s_xy / s_xx : 0.0;
  return {(y - slope * x) / w, slope};
}

double PointSums::residual() const {
  if (w <= 0.0) return 0.0;
  const double s_xx = xx - x * x / w, s_xy = xy - x * y / w, s_yy = yy - y * y / w;
  return std::max(0.0, s_xx > kOnePlace ? s_yy - s_xy * s_xy / s_xx : s_yy);
}

}  // namespace cca
