// SPDX-License-Identifier: BSD-3-Clause
#include "slam/contradiction_monitor.hpp"

#include <algorithm>

namespace cca {
namespace {

/// A scan that agrees by so much less than usual contradicts the map.
constexpr double kUnlike = 0.25;
/// Share of each scan in the running mean: the last twenty count.
constexpr double kUsualShare = 0.05;
/// A scan that is taken for one of another place agrees there by all but this as well as usual.
constexpr double kNearlyUsual = 0.1;
/// It agrees better than here by this: nearly all scans at their right place differ by less.
constexpr double kClearlyBetter = 0.2;
/// And shares at least this part of the returns with earlier scans that it shares here: a pose that
/// hides from all earlier scans agrees with everything.
constexpr double kLeastInCommonElsewhere = 0.5;
/// Minimum overlap with earlier scans (share of returns). Below it a scan cannot contradict the
/// map.
constexpr double kLeastInCommon = 0.1;
/// Contradicting scans in a row after which the robot is lost, once it has driven so far.
constexpr int kLostScans = 3;
constexpr double kLostWay = 1.0;  // m; turns on the spot among people contradict, too
/// m with turns: some 80 degrees on the spot. Contradicting scans that agree by kOfOnePlace with
/// one another show one place, and neither people nor the floor.
constexpr double kLostWayOfOnePlace = 2.0, kOfOnePlace = 0.9;
/// 1/m^2, 1/rad^2; information of the odometry about the step between two of them: 5 cm and 6
/// degrees.
const Eigen::Vector3d kStepInformation(400.0, 400.0, 100.0);

}  // namespace

/// Scans of one place that contradict the map say that the robot is not where the map has it: a
/// scan that agrees with the map by half does not end that.
double ContradictionMonitor::leastAgreement() const {
  const bool is_elsewhere =
      static_cast<int>(run_.scans.size()) >= kLostScans && run_.agrees_with_itself;
  return is_elsewhere ? run_.usual - kNearlyUsual : usual_ - kUnlike;
}

bool ContradictionMonitor::isContradiction(const LocalMatch& found, std::size_t returns) const {
  return found.agreement < leastAgreement() &&
         found.in_common > kLeastInCommon * static_cast<double>(returns);
}

bool ContradictionMonitor::isClearlyBetter(const LocalMatch& there, const LocalMatch& here) const {
  return there.agreement > here.agreement + kClearlyBetter &&
         there.agreement > usual_ - kNearlyUsual &&
         there.in_common > kLeastInCommonElsewhere * here.in_common;
}

bool ContradictionMonitor::isUsual(const SightCount& sights) const {
  return sights.agreement() >= usual_ - kUnlike;
}

void ContradictionMonitor::learn(double agreement, bool contradicts, const Pose2& step) {
  const double scans = contradicts ? std::min(1.0, wayWithTurns(step) / kFrameDistance) : 1.0;
  usual_ += kUsualShare * scans * (agreement - usual_);
}

void ContradictionMonitor::add(const Pose2& step, const ScanSurface& surface) {
  if (run_.scans.empty()) {
    run_.usual = usual_;
  } else {
    // The odometry alone turns too far off within a radian.
    const PoseBelief by_odometry{step, kStepInformation.asDiagonal()};
    const Pose2 matched =
        matchSurface(surface, step, by_odometry, {{&run_.scans.back(), Pose2{}}}, kFirstMatchReach)
            .T_map_query;
    run_.T_first_last = run_.T_first_last * matched;
    const auto agreesWith = [&](const ScanSurface& before, const Pose2& T_before_now) {
      return mutualSights(before, surface, T_before_now).agreement() > kOfOnePlace;
    };
    run_.agrees_with_itself = run_.agrees_with_itself && agreesWith(run_.scans.back(), matched) &&
                              agreesWith(run_.scans.front(), run_.T_first_last);
  }
  run_.scans.push_back(surface);
  run_.way += step.position().norm();
  run_.way_with_turns += wayWithTurns(step);
}

bool ContradictionMonitor::isLost() const {
  const int scans = static_cast<int>(run_.scans.size());
  if (scans >= kStandingScans) return true;
  return scans >= kLostScans &&
         (run_.way >= kLostWay ||
          (run_.agrees_with_itself && run_.way_with_turns >= kLostWayOfOnePlace));
}

}  // namespace cca
