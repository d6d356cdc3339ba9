// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/scan_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/median.hpp"

namespace cca {
namespace {

// Of the wheels, since the first of equal scans: any laser's readings change by then.
constexpr double kMovedOn = 0.05;                 // m
constexpr double kTurnedOn = 2.0 * M_PI / 180.0;  // rad, by the wheels: ten beams of a fine laser
constexpr std::size_t kLeastReturns = 10;         // fewer may be equal by chance

bool areEqual(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

bool hasMoved(const Pose2& from, const Pose2& to) {
  return (to.position() - from.position()).norm() > kMovedOn ||
         std::abs(wrapAngle(to.theta - from.theta)) > kTurnedOn;
}

}  // namespace

double medianReturn(const Scan& scan) {
  std::vector<double> returns;
  for (const double range : scan.ranges) {
    if (isReturn(range)) returns.push_back(range);
  }
  return median(std::move(returns));
}

ScanFault ScanFaults::check(const Scan& scan, const std::optional<Pose2>& T_odom_robot) {
  const auto returns = std::count_if(scan.ranges.begin(), scan.ranges.end(), isReturn);
  const bool is_equal =
      static_cast<std::size_t>(returns) >= kLeastReturns && areEqual(scan.ranges, ranges_);
  if (!is_equal) {
    ranges_ = scan.ranges;
    T_odom_robot_ = T_odom_robot;
  } else if (T_odom_robot && T_odom_robot_ && hasMoved(*T_odom_robot_, *T_odom_robot)) {
    return ScanFault::kRepeated;
  }
  return medianReturn(scan) > kLongestMedian ? ScanFault::kMillimetres : ScanFault::kNone;
}

}  // namespace cca
