// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/near_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

// Of a patch, to each side: sigmas, and m at most: the thinnest thing that is told from a wall.
// What bends within it is taken for nearer than it is.
constexpr double kPatchSigmas = 1.7, kWidestPatch = 0.05;
constexpr double kOfSurface = 4.0;  // sigmas, from what the present scan says
constexpr double kSlope = 1.0;      // usual slope of a surface against the beam's normal
constexpr double kDisagree = 2.0;   // deviations, of one side from the other
// Deviations that a surface may be nearer, and how much of that the least clearance allows for, m.
constexpr double kSure = 3.5, kAllowedFor = 0.008;

// As many scans as make the face of a surface at kClose, m, known to within kWanted, m; but one
// that reads far must never be enough to go a step nearer: a robot that waits beside a wall would
// creep into it, scan by scan.
constexpr double kClose = 0.3, kWanted = 0.002;
constexpr std::size_t kLeastScans = 5;  // of which one that reads far weighs a fifth at most

double patchOf(double range_sigma) { return std::min(kPatchSigmas * range_sigma, kWidestPatch); }

// The end of a line is known half as well as the mean of its points.
std::size_t scansWanted(double spacing, double range_sigma) {
  const double returns = 2.0 * patchOf(range_sigma) / (kClose * spacing);  // of a patch
  const double scans = std::pow(2.0 * range_sigma / kWanted, 2) / returns;
  return scans < NearSurfaces::kMostScans ? std::max(kLeastScans, static_cast<std::size_t>(scans))
                                          : NearSurfaces::kMostScans;
}

// A line v = a + b u through points of one deviation, with a prior for b.
class LineEnd {
 public:
  explicit LineEnd(double sigma) : variance_(sigma * sigma), uu_(variance_ / (kSlope * kSlope)) {}
  void add(double u, double v) {
    n_ += 1.0;
    u_ += u;
    v_ += v;
    uu_ += u * u;
    uv_ += u * v;
  }
  bool isKnown() const { return n_ > 0.0; }
  double at() const { return (uu_ * v_ - u_ * uv_) / determinant(); }  // a
  double variance() const { return variance_ * uu_ / determinant(); }  // of a

 private:
  double determinant() const { return n_ * uu_ - u_ * u_; }
  double variance_, n_ = 0.0, u_ = 0.0, v_ = 0.0, uu_, uv_ = 0.0;
};

// The nearest that a surface may be, as far as the least clearance does not allow for it.
double nearestPlace(const LineEnd& left, const LineEnd& right) {
  const double apart = left.at() - right.at();
  const double variance = left.variance() + right.variance();
  double place = 0.0, of_place = 0.0;
  if (apart * apart > kDisagree * kDisagree * variance) {
    const LineEnd& nearer = apart < 0.0 ? left : right;
    place = nearer.at();
    of_place = nearer.variance();
  } else {
    place = (left.at() * right.variance() + right.at() * left.variance()) / variance;
    of_place = left.variance() * right.variance() / variance;
  }
  return place - std::max(0.0, kSure * std::sqrt(of_place) - kAllowedFor);
}

}  // namespace

Scan NearSurfaces::update(const Scan& raw, const Scan& smooth, const std::vector<bool>& moving,
                          double range_sigma) {
  const Pose2& T = raw.T_map_sensor;
  const bool is_usable =
      isFinite(T) && std::isfinite(raw.angle_increment) && raw.angle_increment != 0.0;
  if (range_sigma <= kUsualSigma || !is_usable) {
    scans_.clear();
    return smooth;
  }
  const double spacing = std::abs(raw.angle_increment);
  const std::size_t most = scansWanted(spacing, range_sigma);
  while (scans_.size() >= most) scans_.pop_front();
  scans_.emplace_back();
  const auto n = static_cast<int>(raw.size());
  std::vector<Eigen::Vector2d> directions;
  for (int i = 0; i < n; ++i) {
    const auto beam = static_cast<std::size_t>(i);
    directions.emplace_back(std::cos(raw.bearing(beam)), std::sin(raw.bearing(beam)));
    const double range = raw.ranges[beam];
    if (!isReturn(range) || range > kNear + kOfSurface * range_sigma || moving[beam]) continue;
    scans_.back().push_back(raw.T_map_sensor * Eigen::Vector2d(range * directions.back()));
  }
  sortByBeam(raw);
  const int turn = static_cast<int>(std::lround(2.0 * M_PI / spacing));
  Scan steady = smooth;
  for (int i = 0; i < n; ++i) {
    const auto beam = static_cast<std::size_t>(i);
    const double range = smooth.ranges[beam];
    if (!isReturn(range) || range > kNear || moving[beam]) continue;
    const double own = 0.5 * spacing * range;  // m, half the width of the beam's sector
    const double patch = std::max(patchOf(range_sigma), own);
    const int reach = static_cast<int>(std::min(std::ceil(patch / (2.0 * own)), 0.5 * n));
    LineEnd left(range_sigma), right(range_sigma);
    for (int k = i - reach; k <= i + reach; ++k) {
      const int j = k < 0 ? k + turn : k >= n ? k - turn : k;  // around a full turn
      if (j < 0 || j >= n) continue;
      for (std::size_t p = first_[static_cast<std::size_t>(j)];
           p < first_[static_cast<std::size_t>(j) + 1]; ++p) {
        const double u = cross(directions[beam], by_beam_[p]),
                     v = directions[beam].dot(by_beam_[p]);
        if (std::abs(u) > patch || std::abs(v - range) > kOfSurface * range_sigma + std::abs(u))
          continue;
        if (u > -own) left.add(u, v);
        if (u < own) right.add(u, v);
      }
    }
    if (!left.isKnown() || !right.isKnown()) continue;
    const double place = nearestPlace(left, right);
    if (place > 0.0) steady.ranges[beam] = place;
  }
  return steady;
}

// What the present scan may say more about: all points, by the beams next to them.
void NearSurfaces::sortByBeam(const Scan& scan) {
  const auto toSensor = transformBy(scan.T_map_sensor.inverse());
  const auto n = static_cast<int>(scan.size());
  points_.clear();
  first_.assign(scan.size() + 1, 0);
  for (const auto& points : scans_) {
    for (const Eigen::Vector2d& p : points) {
      const Eigen::Vector2d p_sensor = toSensor(p);
      const int beam = beamTowards(scan, p_sensor);
      if (beam < 0 || beam >= n) continue;
      points_.push_back({p_sensor, beam});
      ++first_[static_cast<std::size_t>(beam) + 1];
    }
  }
  for (std::size_t i = 0; i < scan.size(); ++i) first_[i + 1] += first_[i];
  by_beam_.resize(points_.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const Point& p : points_) by_beam_[next[static_cast<std::size_t>(p.beam)]++] = p.p_sensor;
}

}  // namespace cca
