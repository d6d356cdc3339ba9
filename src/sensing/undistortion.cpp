// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/undistortion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/cross.hpp"
#include "sensing/beam.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

constexpr double kLeastTurn = 0.05;  // of a beam's spacing, at the ends of the sweep
constexpr double kLeastWay = 1e-3;   // m, likewise; below the noise of any laser
constexpr double kWidestGap = 0.75;  // of a beam's spacing, from a bearing to the beam taken for it
constexpr double kSmallAngle = 1e-6;  // rad, below which an arc is a straight line
constexpr double kBend = 0.25;        // of a step in inverse range from neighbour to neighbour
/// m, the thickness of a partition; a surface that ends at a return is not known to go on by more.
/// Moved along a wall that the beam grazes, it would lie behind the corner, and behind its wall.
constexpr double kBeyond = 0.1;
constexpr double kInvalid = std::numeric_limits<double>::quiet_NaN();

bool isNoMatter(const Scan& scan, const Twist& sensor) {
  const double half = 0.5 * std::abs(scan.sweep_duration);
  return !(std::abs(sensor.angular) * half > kLeastTurn * std::abs(scan.angle_increment) ||
           sensor.linear.norm() * half > kLeastWay);
}

/// A beam of the sweep as the sensor would see it from the middle.
struct Moved {
  double bearing;  ///< rad, from beam 0's on in the direction of the beams, not wrapped
  double range;    ///< m; what is no return stays what it is
};

std::vector<Moved> movedBeams(const Scan& scan, const Twist& before, const Twist& after) {
  const auto n = static_cast<double>(scan.size());
  std::vector<Moved> moved;
  moved.reserve(scan.size());
  // Constant acceleration, of which the two are the means.
  const Twist middle{0.5 * (before.linear + after.linear), 0.5 * (before.angular + after.angular)};
  const double half = 0.5 * std::abs(scan.sweep_duration);
  const Twist change{(after.linear - before.linear) / half,
                     (after.angular - before.angular) / half};
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double time = scan.sweep_duration * (static_cast<double>(i) / (n - 1.0) - 0.5);
    const Twist mean{middle.linear + 0.5 * time * change.linear,
                     middle.angular + 0.5 * time * change.angular};
    const Pose2 T = moveBy(mean, time);
    const double bearing = scan.bearing(i), range = scan.ranges[i];
    double turn = T.theta, length = range;
    if (isReturn(range)) {
      const double angle = bearing + T.theta;
      const Eigen::Vector2d beam = range * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d p = T.position() + beam;
      length = p.norm();
      turn += std::atan2(cross(beam, p), beam.dot(p));
    }
    moved.push_back({bearing + turn, length});
  }
  return moved;
}

/// Whether the two are of one surface: near to each other, or in line with a third one, as on a
/// wall that the beams graze. Inverse ranges of a wall are linear over the small angles between
/// beams.
bool areOfOneSurface(const Moved& here, const Moved& beside, const Moved& beyond) {
  if (!isReturn(beside.range)) return false;
  if (std::abs(beside.range - here.range) < kOneSurface * here.range) return true;
  if (!isReturn(beyond.range)) return false;
  const double step = 1.0 / beside.range - 1.0 / here.range;
  const double before = 1.0 / here.range - 1.0 / beyond.range;
  return std::abs(step - before) < kBend * std::abs(step + before);
}

/// m, the range at a bearing of the surface that beam i saw: between it and the beam on that side,
/// or on from two beams, which are close to each other where the sweep overlaps itself.
double rangeBeside(const std::vector<Moved>& moved, std::size_t i, double bearing, bool closed) {
  const std::size_t n = moved.size();
  const Moved& here = moved[i];
  if (!isReturn(here.range) || (!closed && (i == 0 || i + 1 == n))) return here.range;
  const Moved *toward = &moved[(i + 1) % n], *away = &moved[(i + n - 1) % n];
  const double off = wrapAngle(bearing - here.bearing);
  if ((wrapAngle(toward->bearing - here.bearing) > 0.0) != (off > 0.0)) std::swap(toward, away);
  const Moved* const other = areOfOneSurface(here, *toward, *away)   ? toward
                             : areOfOneSurface(here, *away, *toward) ? away
                                                                     : nullptr;
  const double angle = other ? wrapAngle(other->bearing - here.bearing) : 0.0;
  if (angle == 0.0) return here.range;
  const double range =
      1.0 / (1.0 / here.range + (1.0 / other->range - 1.0 / here.range) / angle * off);
  const bool is_between = other == toward && off / angle >= 0.0 && off / angle <= 1.0;
  if (!is_between && !(std::abs(range - here.range) <= kBeyond)) return kInvalid;
  return range;
}

}  // namespace

Twist twistBetween(const Pose2& from, const Pose2& to, double dt) {
  const Pose2 motion = from.inverse() * to;
  // The inverse of moveBy(): the arc's chord, turned back by half the turn and stretched.
  const double half = 0.5 * motion.theta;
  const double stretch = std::abs(half) < kSmallAngle ? 1.0 : half / std::sin(half);
  const double c = std::cos(half), s = std::sin(half);
  const Eigen::Vector2d p = motion.position() * stretch / dt;
  return {{c * p.x() + s * p.y(), c * p.y() - s * p.x()}, motion.theta / dt};
}

Pose2 moveBy(const Twist& twist, double dt) {
  const double half = 0.5 * twist.angular * dt;
  const double shrink = std::abs(half) < kSmallAngle ? 1.0 : std::sin(half) / half;
  const double c = std::cos(half), s = std::sin(half);
  const Eigen::Vector2d p = twist.linear * dt * shrink;
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), wrapAngle(2.0 * half)};
}

Twist sensorTwist(const Twist& robot, const Pose2& T_robot_sensor) {
  const Eigen::Vector2d lever = T_robot_sensor.position();
  const Eigen::Vector2d v = robot.linear + robot.angular * Eigen::Vector2d(-lever.y(), lever.x());
  const double c = std::cos(T_robot_sensor.theta), s = std::sin(T_robot_sensor.theta);
  return {{c * v.x() + s * v.y(), c * v.y() - s * v.x()}, robot.angular};
}

bool isBent(const Scan& scan, const Twist& before, const Twist& after) {
  return scan.size() > 1 && scan.angle_increment != 0.0 &&
         !(isNoMatter(scan, before) && isNoMatter(scan, after));
}

Scan undistort(const Scan& scan, const Twist& before, const Twist& after) {
  Scan still = scan;
  still.sweep_duration = 0.0;
  if (!isBent(scan, before, after)) return still;
  const std::size_t n = scan.size();
  still.bearing_sigma = kUniformToSigma * std::abs(scan.angle_increment);
  const std::vector<Moved> moved = movedBeams(scan, before, after);
  const bool closed = seesAllAround(scan);
  // Of each bearing, the beam that lies nearest.
  std::vector<std::size_t> nearest(n, n);
  std::vector<double> off(n, kWidestGap);
  for (std::size_t i = 0; i < n; ++i) {
    const double at = beamAt(moved[i].bearing, scan.angle_min, scan.angle_increment);
    for (const double step : {-1.0, 0.0, 1.0}) {
      double beam = std::round(at) + step;
      if (closed) beam = beam < 0.0 ? beam + n : beam >= n ? beam - n : beam;
      if (!(beam >= 0.0 && beam < static_cast<double>(n))) continue;
      const auto j = static_cast<std::size_t>(beam);
      const double apart =
          std::abs(wrapAngle(moved[i].bearing - scan.bearing(j))) / std::abs(scan.angle_increment);
      if (apart >= off[j]) continue;
      off[j] = apart;
      nearest[j] = i;
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    still.ranges[j] =
        nearest[j] == n ? kInvalid : rangeBeside(moved, nearest[j], scan.bearing(j), closed);
  }
  return still;
}

}  // namespace cca
