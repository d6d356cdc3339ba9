// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/local_view.hpp"

#include <algorithm>
#include <cmath>

#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kGrazingAngle = 10.0 * M_PI / 180.0;  // incidence up to which a wall is one wall
constexpr double kSpacing = 0.05;  // m; the discs of neighbouring samples dent by 1 mm only
constexpr int kBeamsAcross = 3;    // invalid beams in a row that a surface may span

struct Return {
  std::size_t beam;
  double range;
  bool moving;
  Eigen::Vector2d p_map;
};

// Borges & Aldon: the spacing that two neighbouring beams have on a surface at grazing incidence.
double largestSpacing(double near_range, double angle) {
  if (angle >= kGrazingAngle) return near_range;
  return near_range * std::sin(angle) / std::sin(kGrazingAngle - angle);
}

// What moves is no obstacle to plan around, and ends the surfaces that it hides.
void add(const Eigen::Vector2d& p_map, bool moving, LocalView& view) {
  if (moving) {
    view.movers.push_back(p_map);
    if (!view.ends_here.empty()) view.ends_here.back() = true;
    return;
  }
  view.obstacles.push_back(p_map);
  view.ends_here.push_back(false);
}

// What lies between two returns that follow each other in beam order.
void addPair(const Scan& scan, const Return& a, const Return& b, std::size_t beams_apart,
             bool open_between, double passable_gap, LocalView& view) {
  const double gap = (a.p_map - b.p_map).norm();
  const double angle = static_cast<double>(beams_apart) * std::abs(scan.angle_increment);
  const double spacing = largestSpacing(std::min(a.range, b.range), angle);
  const bool together = static_cast<int>(beams_apart) <= kBeamsAcross && !open_between;
  if (!together || gap > std::max(spacing, passable_gap)) {
    if (!a.moving && view.obstacles.back() != a.p_map) add(a.p_map, false, view);
    if (!view.ends_here.empty()) view.ends_here.back() = true;
    add(b.p_map, b.moving, view);
    return;
  }
  const int pieces = static_cast<int>(std::ceil(gap / kSpacing));
  for (int i = 1; i < pieces; ++i)
    add(a.p_map + (b.p_map - a.p_map) * i / pieces, a.moving || b.moving, view);
}

// Beams that run clockwise give points that do.
void reverse(LocalView& view) {
  std::reverse(view.obstacles.begin(), view.obstacles.end());
  std::reverse(view.ends_here.begin(), view.ends_here.end());
  if (view.ends_here.empty()) return;
  std::rotate(view.ends_here.begin(), view.ends_here.begin() + 1, view.ends_here.end());
}

}  // namespace

int LocalView::beamTowards(const Eigen::Vector2d& p_map) const {
  if (seen.empty() || angle_increment == 0.0) return -1;
  const Eigen::Vector2d to = p_map - T_map_sensor.position();
  const double turn = 2.0 * M_PI / std::abs(angle_increment);
  const double beam =
      beamAt(std::atan2(to.y(), to.x()) - T_map_sensor.theta, angle_min, angle_increment);
  const auto n = static_cast<int>(seen.size());
  const int index = static_cast<int>(std::lround(std::max(beam, 0.0)));
  if (index < n) return index;
  return index == n && turn - beam < 1.0 ? 0 : -1;
}

double LocalView::seenDistanceTowards(const Eigen::Vector2d& p_map) const {
  const int beam = beamTowards(p_map);
  return beam < 0 ? 0.0 : seen[static_cast<std::size_t>(beam)];
}

LocalView makeLocalView(const Scan& scan, const std::vector<bool>& moving, const Pose2& T_map_robot,
                        double passable_gap) {
  LocalView view;
  view.T_map_robot = T_map_robot;
  view.T_map_sensor = scan.T_map_sensor;
  view.angle_min = scan.angle_min;
  view.angle_increment = scan.angle_increment;
  view.seen.assign(scan.size(), 0.0);
  std::vector<Return> returns;
  returns.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double range = scan.ranges[i];
    if (isReturn(range)) {
      returns.push_back({i, range, !moving.empty() && moving[i], returnOf(scan, i)});
    }
    view.seen[i] = scan.freeRange(i);
    view.horizon = std::max(view.horizon, view.seen[i]);
  }
  const std::size_t n = returns.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Return& a = returns[k];
    if (!a.moving) view.returns.push_back(a.p_map);
    if (a.moving || view.obstacles.empty() ||
        (view.obstacles.back() - a.p_map).norm() >= 0.5 * kSpacing) {
      add(a.p_map, a.moving, view);
    }
    if (k + 1 == n && !seesAllAround(scan)) break;
    const Return& b = returns[(k + 1) % n];
    const std::size_t apart = (b.beam + scan.size() - a.beam - 1) % scan.size() + 1;
    bool open_between = false;
    for (std::size_t j = 1; j < apart; ++j) {
      open_between = open_between || isNoReturn(scan.ranges[(a.beam + j) % scan.size()]);
    }
    addPair(scan, a, b, apart, open_between, passable_gap, view);
  }
  if (!view.ends_here.empty() && !seesAllAround(scan)) view.ends_here.back() = true;
  if (scan.angle_increment < 0.0) reverse(view);
  return view;
}

bool LocalView::onOneSurface(int a, int b) const {
  const int n = static_cast<int>(obstacles.size());
  const auto bearing = [&](int i) {
    const Eigen::Vector2d to = obstacles[static_cast<std::size_t>(i)] - T_map_sensor.position();
    return std::atan2(to.y(), to.x());
  };
  if (wrapAngle(bearing(b) - bearing(a)) < 0.0) std::swap(a, b);
  for (int i = a; i != b; i = (i + 1) % n) {
    if (ends_here[static_cast<std::size_t>(i)]) return false;
  }
  return true;
}

int LocalView::surfaceEnd(int from, bool counter_clockwise) const {
  const int n = static_cast<int>(obstacles.size());
  const auto endsAt = [&](int i) { return ends_here[static_cast<std::size_t>(i)]; };
  int i = from;
  for (int steps = 0; steps < n; ++steps) {
    const int before = (i + n - 1) % n;
    if (counter_clockwise ? endsAt(i) : endsAt(before)) return i;
    i = counter_clockwise ? (i + 1) % n : before;
  }
  return from;
}

}  // namespace cca
