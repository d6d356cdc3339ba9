// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cca_mrpt/geometry/arc.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr int kFewestOfCircle = 4;   // three always lie on a circle
constexpr int kMostSteps = 10;       // Gauss-Newton from a good circle needs three or four
constexpr double kConverged = 1e-9;  // m; far below what any laser measures
constexpr double kFlattest = 1e3;    // radii per spread of the points: a line

struct Circle {
  Eigen::Vector2d centre;
  double radius;
};

using Iterator = std::vector<CurvePoint>::const_iterator;

/// A term of the fit: how far a point, or a ray that should touch, is off a circle, and how that
/// changes with centre and radius.
struct Residual {
  double off;
  Eigen::Vector3d gradient;
};

Residual residual(const Circle& circle, const Eigen::Vector2d& point) {
  const Eigen::Vector2d d = point - circle.centre;
  const double range = d.norm();
  const Eigen::Vector2d out = range > 0.0 ? Eigen::Vector2d(d / range) : Eigen::Vector2d::UnitX();
  return {range - circle.radius, {-out.x(), -out.y(), -1.0}};
}

/// @param side  +1 where the circle lies on the left of the ray, -1 on the right.
Residual residual(const Circle& circle, const Eigen::Vector2d& ray, double side) {
  return {side * cross(ray, circle.centre) - circle.radius,
          {-side * ray.y(), side * ray.x(), -1.0}};
}

/// Chi-square, J^T W J and J^T W r.
struct NormalEquations {
  double chi_square = 0.0;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();

  NormalEquations(const Circle& circle, Iterator first, Iterator last,
                  const std::optional<Limbs>& limbs) {
    for (auto p = first; p != last; ++p) add(residual(circle, p->position), p->variance);
    if (!limbs) return;
    add(residual(circle, limbs->first, 1.0), limbs->variance);
    add(residual(circle, limbs->last, -1.0), limbs->variance);
  }
  void add(const Residual& r, double variance) {
    chi_square += r.off * r.off / variance;
    information += r.gradient * r.gradient.transpose() / variance;
    gradient += r.gradient * (r.off / variance);
  }
};

/// A circle between two rays, as far away as the nearest point.
std::optional<Circle> circleBetween(const Limbs& limbs, Iterator first, Iterator last) {
  double nearest = first->position.norm();
  for (auto p = first; p != last; ++p) nearest = std::min(nearest, p->position.norm());
  const Eigen::Vector2d middle = (limbs.first + limbs.last).normalized();
  const double sine = cross(limbs.first, middle);
  if (!(sine > 0.0) || !(sine < 1.0)) return std::nullopt;
  const double distance = nearest / (1.0 - sine);
  return Circle{distance * middle, distance * sine};
}

/// Taubin's fit: the least eigenvalue of a pencil of moments, by Newton from below.
std::optional<Circle> taubinFit(Iterator first, Iterator last) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (auto p = first; p != last; ++p) {
    mean += p->position / p->variance;
    weight += 1.0 / p->variance;
  }
  mean /= weight;
  double xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0, zz = 0.0;
  for (auto p = first; p != last; ++p) {
    const Eigen::Vector2d d = p->position - mean;
    const double z = d.squaredNorm(), w = 1.0 / (p->variance * weight);
    xx += w * d.x() * d.x();
    xy += w * d.x() * d.y();
    yy += w * d.y() * d.y();
    xz += w * d.x() * z;
    yz += w * d.y() * z;
    zz += w * z * z;
  }
  const double z = xx + yy, cov = xx * yy - xy * xy, var_z = zz - z * z;
  const double a3 = 4.0 * z, a2 = -3.0 * z * z - zz;
  const double a1 = var_z * z + 4.0 * cov * z - xz * xz - yz * yz;
  const double a0 = xz * (xz * yy - yz * xy) + yz * (yz * xx - xz * xy) - var_z * cov;
  double x = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const double slope = a1 + x * (2.0 * a2 + x * 3.0 * a3);
    if (slope == 0.0) break;
    const double next = x - (a0 + x * (a1 + x * (a2 + x * a3))) / slope;
    if (!std::isfinite(next) || next < 0.0 || std::abs(next - x) <= 1e-12 * z) break;
    x = next;
  }
  const double det = x * x - x * z + cov;
  if (!(std::abs(det) > 0.0)) return std::nullopt;
  const Eigen::Vector2d centre(0.5 * (xz * (yy - x) - yz * xy) / det,
                               0.5 * (yz * (xx - x) - xz * xy) / det);
  const double radius = std::sqrt(centre.squaredNorm() + z);
  if (!(radius < kFlattest * std::sqrt(z))) return std::nullopt;
  return Circle{mean + centre, radius};
}

/// The piece of the circle from the first point to the last, by way of those between.
void setEnds(Iterator first, Iterator last, Arc* arc) {
  Eigen::Vector2d before = first->position - arc->centre;
  double sweep = 0.0;
  for (auto p = first + 1; p != last; ++p) {
    const Eigen::Vector2d here = p->position - arc->centre;
    sweep += std::atan2(cross(before, here), before.dot(here));
    before = here;
  }
  const Eigen::Vector2d start =
      (sweep < 0.0 ? (last - 1)->position : first->position) - arc->centre;
  arc->start_angle = std::atan2(start.y(), start.x());
  arc->sweep = std::min(std::abs(sweep), 2.0 * M_PI);
}

}  // namespace

Eigen::Vector2d Arc::at(double share) const {
  const double angle = start_angle + share * sweep;
  return centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

std::optional<FittedArc> fitArc(const std::vector<CurvePoint>& points, int first, int last,
                                const std::optional<Limbs>& limbs) {
  if (last - first < (limbs ? 2 : kFewestOfCircle)) return std::nullopt;
  const auto from = points.begin() + first, to = points.begin() + last;
  auto circle = limbs ? circleBetween(*limbs, from, to) : taubinFit(from, to);
  if (!circle) return std::nullopt;
  NormalEquations here(*circle, from, to, limbs);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector3d change = -(here.information.inverse() * here.gradient);
    const Circle next{circle->centre + change.head<2>(), circle->radius + change.z()};
    const NormalEquations there(next, from, to, limbs);
    if (!change.allFinite() || next.radius <= 0.0 || !(there.chi_square <= here.chi_square)) break;
    circle = next;
    here = there;
    if (change.norm() < kConverged) break;
  }
  FittedArc fitted;
  fitted.chi_square = here.chi_square;
  fitted.arc.centre = circle->centre;
  fitted.arc.radius = circle->radius;
  fitted.arc.support = last - first;
  fitted.arc.covariance = here.information.inverse();
  setEnds(from, to, &fitted.arc);
  if (!fitted.arc.covariance.allFinite() || !(fitted.arc.sweep > 0.0)) return std::nullopt;
  return fitted;
}

}  // namespace cca
