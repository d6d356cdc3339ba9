// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/scan_message.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/median.hpp"
#include "io/files/text.hpp"

namespace cca {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Drivers round 2 pi / n up and repeat the first beam at the end.
constexpr double kFullTurn = 2.0 * M_PI + 0.05;
/// Drivers count one beam too many or too few, round their increment, and turn not quite evenly.
constexpr double kSlowestLaser = 1.0;  // s, a sweep; drivers are wrong by orders of magnitude
constexpr double kBeamsOff = 2.5, kShareOff = 0.1;

/// m. No 2-D laser has half of its returns from farther off, and no room is so small that half of
/// its walls are nearer in millimetres.
constexpr double kFarthestMedian = 250.0;

template <class... Values>
void refuseUnless(bool sound, const char* rule, const char* pattern, Values... values) {
  if (sound) return;
  throw MalformedScan(rule, formatted(pattern, values...));
}

void check(const sensor_msgs::LaserScan& m) {
  refuseUnless(std::isfinite(m.angle_min), "angle_min must be finite", "it is %g", m.angle_min);
  refuseUnless(std::isfinite(m.angle_increment), "angle_increment must be finite", "it is %g",
               m.angle_increment);
  refuseUnless(std::isfinite(m.time_increment), "time_increment must be finite", "it is %g",
               m.time_increment);
  refuseUnless(m.range_max > 0.0f && m.range_max > m.range_min,
               "range_max must be positive and above range_min", "range_max %g, range_min %g",
               m.range_max, m.range_min);
  if (m.ranges.size() < 2) return;
  refuseUnless(m.angle_increment != 0.0f, "angle_increment must not be 0", "%zu beams",
               m.ranges.size());
  const double field_of_view =
      std::abs(m.angle_increment) * static_cast<double>(m.ranges.size() - 1);
  refuseUnless(field_of_view <= kFullTurn, "the beams must not cover more than one turn",
               "%zu beams, angle_increment %g", m.ranges.size(), m.angle_increment);
}

/// A driver that loses beams, or counts them the other way round, contradicts itself. An angle_max
/// of 0 is one that nobody has filled in.
void checkFieldOfView(const sensor_msgs::LaserScan& m) {
  if (m.ranges.empty() || m.angle_increment == 0.0f || m.angle_max == 0.0f) return;
  const double declared = static_cast<double>(m.angle_max) - m.angle_min;
  const double covered = m.angle_increment * (static_cast<double>(m.ranges.size()) - 1.0);
  const double allowed = std::max(kBeamsOff * std::abs(m.angle_increment),
                                  kShareOff * std::max(std::abs(declared), std::abs(covered)));
  refuseUnless(std::abs(declared - covered) <= allowed,
               "ranges and angle_increment must lead from angle_min to angle_max",
               "%zu beams of angle_increment %g lead from angle_min %g to %g, not to angle_max %g",
               m.ranges.size(), m.angle_increment, m.angle_min, m.angle_min + covered, m.angle_max);
}

/// Readings like the largest one are left out: drivers have numbers of their own for no return.
void checkUnit(const sensor_msgs::LaserScan& m) {
  std::vector<float> returns;
  for (const float range : m.ranges) {
    if (std::isfinite(range) && range > 0.0f) returns.push_back(range);
  }
  if (returns.empty()) return;
  const float largest = *std::max_element(returns.begin(), returns.end());
  const auto isLargest = [&](float range) { return range >= 0.999f * largest; };
  returns.erase(std::remove_if(returns.begin(), returns.end(), isLargest), returns.end());
  if (returns.empty()) return;
  const float middle = median(std::move(returns));
  refuseUnless(middle <= kFarthestMedian, "ranges must be metres: they look like millimetres",
               "half of the returns are beyond %g, range_max %g", middle, m.range_max);
}

/// s, from the first beam to the last as the message tells it; 0 where it does not, or is absurd.
double sweepDuration(const sensor_msgs::LaserScan& message) {
  const auto beams = static_cast<double>(message.ranges.size());
  const double duration = (beams - 1.0) * message.time_increment;
  return beams >= 2.0 && std::abs(duration) <= kSlowestLaser ? duration : 0.0;
}

}  // namespace

Scan scanFromMessage(const sensor_msgs::LaserScan& message) {
  check(message);
  checkFieldOfView(message);
  checkUnit(message);
  Scan scan;
  scan.angle_min = message.angle_min;
  scan.angle_increment = message.angle_increment;
  scan.sweep_duration = sweepDuration(message);
  scan.free_range_without_return = std::isfinite(message.range_max) ? message.range_max : 0.0;
  scan.ranges.reserve(message.ranges.size());
  for (const float range : message.ranges) {
    const bool meant = range > 0.0f && range >= message.range_min;
    const bool beyond = range > message.range_max;
    scan.ranges.push_back(!meant ? kNaN : beyond ? kInfinity : range);
  }
  return scan;
}

sensor_msgs::LaserScan firstEchoes(const sensor_msgs::MultiEchoLaserScan& message) {
  sensor_msgs::LaserScan scan;
  scan.header = message.header;
  scan.angle_min = message.angle_min;
  scan.angle_max = message.angle_max;
  scan.angle_increment = message.angle_increment;
  scan.time_increment = message.time_increment;
  scan.scan_time = message.scan_time;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  scan.ranges.reserve(message.ranges.size());
  for (const auto& beam : message.ranges) {
    scan.ranges.push_back(beam.echoes.empty() ? static_cast<float>(kNaN) : beam.echoes.front());
  }
  return scan;
}

sensor_msgs::LaserScan scanToMessage(const Scan& scan, const LaserLimits& limits,
                                     const std_msgs::Header& header) {
  sensor_msgs::LaserScan message;
  message.header = header;
  message.angle_min = static_cast<float>(scan.angle_min);
  message.angle_increment = static_cast<float>(scan.angle_increment);
  message.angle_max =
      static_cast<float>(scan.size() ? scan.bearing(scan.size() - 1) : scan.angle_min);
  message.range_min = static_cast<float>(limits.range_min);
  message.range_max = static_cast<float>(limits.range_max);
  message.scan_time = static_cast<float>(limits.scan_time);
  message.time_increment = static_cast<float>(limits.time_increment);
  message.ranges.reserve(scan.size());
  for (const double range : scan.ranges) {
    const bool meant = isReturn(range) || isNoReturn(range);
    message.ranges.push_back(static_cast<float>(meant ? range : kNaN));
  }
  return message;
}

ros::Time sweepMiddle(const sensor_msgs::LaserScan& message) {
  return message.header.stamp + ros::Duration(0.5 * sweepDuration(message));
}

double seeingFraction(const Scan& scan) {
  if (std::none_of(scan.ranges.begin(), scan.ranges.end(), isReturn)) return 0.0;
  const auto seeing = std::count_if(scan.ranges.begin(), scan.ranges.end(),
                                    [](double r) { return isReturn(r) || isNoReturn(r); });
  return static_cast<double>(seeing) / static_cast<double>(scan.size());
}

}  // namespace cca
