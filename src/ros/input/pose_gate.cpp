// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/pose_gate.hpp"

#include <cmath>

#include "sensing/gates.hpp"

namespace cca {
namespace {

constexpr double kCorrection = 0.5,
                 kCorrectionTurn = 0.5;  // m, rad; what a localisation corrects in one step
constexpr double kSettled = 1.0;         // s

}  // namespace

bool PoseGate::reachable(const Fix& from, const Fix& to) {
  const double dt = to.time - from.time;
  const double distance = (to.pose.position() - from.pose.position()).norm();
  const double turn = std::abs(wrapAngle(to.pose.theta - from.pose.theta));
  return distance <= kCorrection + kFastest * dt && turn <= kCorrectionTurn + kFastestTurn * dt;
}

PoseGate::Verdict PoseGate::check(const Pose2& pose, double time) {
  const Fix fix{pose, time};
  if (!good_ || reachable(*good_, fix)) {
    good_ = fix;
    candidate_.reset();
    return Verdict::kPlausible;
  }
  if (!candidate_ || !reachable(*candidate_, fix)) candidate_since_ = time;
  candidate_ = fix;
  if (time - candidate_since_ < kSettled) return Verdict::kHeld;
  good_ = fix;
  candidate_.reset();
  return Verdict::kMoved;
}

}  // namespace cca
