// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/moving_points.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/range_noise.hpp"

namespace cca {
namespace {

constexpr double kAge = 0.45;  // s, of the scan to compare with: a walker has gone its own depth
constexpr double kClearly = 0.12;  // m, beyond the noise
constexpr int kBeamsAround = 2;    // of the earlier scan, to each side
constexpr int kLeastBeams = 3;     // of a mover
constexpr double kJoined = 0.2;    // m, between neighbouring returns of a mover
constexpr int kMostJoined = 60;    // beams: not along a whole wall
constexpr double kNearby = 0.4;    // m, of where a mover was

// The shortest free distance that the scan saw around the direction of a point; 0 where unknown.
double seenAround(const Scan& scan, const Eigen::Vector2d& p_sensor) {
  const double turn = 2.0 * M_PI / std::abs(scan.angle_increment);
  double at = std::fmod(
      (std::atan2(p_sensor.y(), p_sensor.x()) - scan.angle_min) / scan.angle_increment, turn);
  if (at < -0.5) at += turn;
  const int beam = static_cast<int>(std::lround(at)), n = static_cast<int>(scan.size());
  if (beam < kBeamsAround || beam >= n - kBeamsAround) return 0.0;
  double least = INFINITY;
  for (int i = beam - kBeamsAround; i <= beam + kBeamsAround; ++i) {
    const double range = scan.ranges[static_cast<std::size_t>(i)];
    least = std::min(least, isReturn(range)     ? range
                            : isNoReturn(range) ? scan.free_range_without_return
                                                : 0.0);
  }
  return least;
}

}  // namespace

std::vector<bool> MovingPoints::update(const Scan& scan, double time) {
  const std::size_t n = scan.size();
  std::vector<bool> moving(n, false);
  std::vector<Eigen::Vector2d> points(n, Eigen::Vector2d::Zero());
  const double c = std::cos(scan.T_map_sensor.theta), s = std::sin(scan.T_map_sensor.theta);
  for (std::size_t i = 0; i < n; ++i) {
    if (!isReturn(scan.ranges[i])) continue;
    const double x = scan.ranges[i] * std::cos(scan.bearing(i));
    const double y = scan.ranges[i] * std::sin(scan.bearing(i));
    points[i] = scan.T_map_sensor.position() + Eigen::Vector2d(c * x - s * y, s * x + c * y);
  }
  const auto joined = [&](std::size_t i, std::size_t j) {
    return isReturn(scan.ranges[i]) && isReturn(scan.ranges[j]) &&
           (points[i] - points[j]).squaredNorm() < kJoined * kJoined;
  };
  std::vector<bool> suspicious(n, false);
  while (past_.size() > 1 && past_[1].time <= time - kAge) past_.pop_front();
  if (!past_.empty() && past_.front().time < time) {
    const Scan& earlier = past_.front().scan;
    const double clearly = kClearly + 4.0 * rangeNoise(scan).range_sigma;
    const Pose2 T_sensor_map = earlier.T_map_sensor.inverse();
    const double ce = std::cos(T_sensor_map.theta), se = std::sin(T_sensor_map.theta);
    for (std::size_t i = 0; i < n; ++i) {
      if (!isReturn(scan.ranges[i]) || scan.ranges[i] > kFarthest) continue;
      const Eigen::Vector2d p(T_sensor_map.x + ce * points[i].x() - se * points[i].y(),
                              T_sensor_map.y + se * points[i].x() + ce * points[i].y());
      suspicious[i] = p.norm() < seenAround(earlier, p) - clearly;
    }
  }
  seen_.erase(std::remove_if(seen_.begin(), seen_.end(),
                             [&](const Seen& seen) { return time - seen.time > kMemory; }),
              seen_.end());
  std::vector<Seen> now;
  for (std::size_t i = 0; i < n;) {
    std::size_t end = i;
    while (end < n && suspicious[end] && (end == i || joined(end - 1, end))) ++end;
    if (end - i < kLeastBeams) {
      i = std::max(end, i + 1);
      continue;
    }
    std::size_t first = i, last = end - 1;
    for (int k = 0; k < kMostJoined && first > 0 && joined(first - 1, first); ++k) --first;
    for (int k = 0; k < kMostJoined && last + 1 < n && joined(last, last + 1); ++k) ++last;
    const Eigen::Vector2d middle = points[(i + end - 1) / 2];
    for (std::size_t j = first; j <= last; ++j) {
      if ((points[j] - middle).norm() < 2.0 * kNearby) moving[j] = true;
    }
    now.push_back({middle, time});
    i = end;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (moving[i] || !isReturn(scan.ranges[i])) continue;
    moving[i] = std::any_of(seen_.begin(), seen_.end(), [&](const Seen& seen) {
      return (seen.p_map - points[i]).squaredNorm() < kNearby * kNearby;
    });
  }
  seen_.insert(seen_.end(), now.begin(), now.end());
  if (!now.empty()) last_seen_ = time;
  past_.push_back({scan, time});
  return moving;
}

}  // namespace cca
