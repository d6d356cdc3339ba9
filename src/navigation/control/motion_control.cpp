// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/motion_control.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {
namespace {

constexpr double kTurningGain = 2.5;  // 1/s; stable at 10 Hz with one period of delay

constexpr double kStep = 0.05;      // s, of the predicted motion
constexpr double kNoMotion = 1e-9;  // m/s: what rounding leaves of a speed that was braked
// m, by which a hazard may come nearer that is inside the clearance, and inside the robot itself: a
// robot that touches something only turns or leaves.
constexpr double kDeeper = 1e-4, kDeeperInside = 1e-9;
constexpr double kPastHazard = 0.5 * M_PI + 0.02;  // rad, from a hazard: past it

double towards(double from, double to, double step) {
  return from < to ? std::min(to, from + step) : std::max(to, from - step);
}

struct Predicted {
  Eigen::Vector2d p_robot;
  double time;
};

using StoppingPath = std::vector<Predicted>;

// The command for one period, to which the base turns as fast as it can, then braking until it
// drives no more. @param turns_faster  rad/s^2.
StoppingPath stoppingPath(const PredictedState& start, const Velocity& command, double turns_faster,
                          const Velocity& brakes, double period) {
  StoppingPath path;
  Pose2 pose = start.T_now_then;
  const Velocity& present = start.velocity;
  Velocity velocity = present;
  double time = start.delay;
  const auto advance = [&](const Velocity& next) {
    const double w = 0.5 * (velocity.angular + next.angular);
    const double v = 0.5 * (velocity.linear + next.linear);
    const double heading = pose.theta + 0.5 * w * kStep;
    pose.x += v * kStep * std::cos(heading);
    pose.y += v * kStep * std::sin(heading);
    pose.theta += w * kStep;
    velocity = next;
    time += kStep;
    path.push_back({pose.position(), time});
  };
  // The command may act late by up to one period or at once: the faster of both is assumed.
  const double linear = std::max(present.linear, command.linear);
  double turned_up = kStep;  // s: ahead by one, as turning at once would be
  while (time < start.delay + period - 1e-9) {
    advance({linear, towards(present.angular, command.angular, turns_faster * turned_up)});
    turned_up += kStep;
  }
  velocity = {linear, command.angular};
  // Until it drives no more: a disc that turns on goes nowhere.
  while (velocity.linear > kNoMotion) {
    advance({towards(velocity.linear, 0.0, brakes.linear * kStep),
             towards(velocity.angular, 0.0, brakes.angular * kStep)});
  }
  return path;
}

// The nearest that the robot comes to a hazard, as far as that may come towards it meanwhile, m.
double nearest(const StoppingPath& path, const Hazard& hazard) {
  double least = std::numeric_limits<double>::infinity();
  for (const Predicted& at : path) {
    const double distance = (hazard.p_robot - at.p_robot).norm();
    least = std::min(least, distance - hazard.closing_speed * at.time);
  }
  return least;
}

// Those that the robot could come near to before it stands.
std::vector<Hazard> hazardsInReach(const std::vector<Hazard>& hazards, double speed, double radius,
                                   double period, const Velocity& brakes,
                                   const std::vector<PredictedState>& others) {
  double v_max = std::max(speed, 0.0), off = 0.0, delay = 0.0;
  for (const PredictedState& other : others) {
    v_max = std::max(v_max, other.velocity.linear);
    off = std::max(off, other.T_now_then.position().norm());
    delay = std::max(delay, other.delay);
  }
  const double time = period + v_max / brakes.linear;
  const double stopping = off + v_max * period + 0.5 * v_max * v_max / brakes.linear;
  std::vector<Hazard> near;
  for (const Hazard& hazard : hazards) {
    const double reach =
        radius - hazard.allowance + stopping + hazard.closing_speed * (delay + time);
    if (hazard.p_robot.squaredNorm() < reach * reach) near.push_back(hazard);
  }
  return near;
}

/// What the accelerations allow within one control period.
struct ReachableVelocities {
  const Velocity& present;
  const RobotParameters& robot;
  double period;  ///< s

  Velocity nearestTo(double v, double w) const {
    v = std::clamp(v, 0.0, robot.max_linear_velocity);
    w = std::clamp(w, -robot.max_angular_velocity, robot.max_angular_velocity);
    const double dv = robot.max_linear_acceleration * period;
    const double dw = robot.max_angular_acceleration * period;
    // What is measured may be beyond the limits, and faster than it is: a command to brake must not
    // be above the velocity, so nothing keeps it from being too low.
    return {std::clamp(std::min(v, present.linear + dv), -robot.max_linear_velocity,
                       robot.max_linear_velocity),
            std::clamp(towards(present.angular, w, dw), -robot.max_angular_velocity,
                       robot.max_angular_velocity)};
  }
};

/// Whether a command is safe: the motion that it starts keeps clear of all hazards until it ends.
class StoppingCheck {
 public:
  /// @param starts   where the command may begin to act; the first is expected.
  /// @param braking  the command to brake: from the other starts as near as it comes is allowed.
  StoppingCheck(std::vector<PredictedState> starts, std::vector<Hazard> hazards,
                const RobotParameters& robot, double radius, double period, const Velocity& brakes,
                const Velocity& braking)
      : starts_(std::move(starts)),
        hazards_(std::move(hazards)),
        keep_(starts_.size()),
        turns_faster_(robot.max_angular_acceleration),
        period_(period),
        brakes_(brakes) {
    for (std::size_t i = 0; i < starts_.size() && !hazards_.empty(); ++i) {
      const auto path = i > 0 ? pathOf(starts_[i], braking) : StoppingPath{};
      for (const Hazard& hazard : hazards_) {
        const double distance = hazard.p_robot.norm();
        const double now = i > 0 ? nearest(path, hazard) : distance;
        const double deeper = i == 0 && distance < robot.radius ? kDeeperInside : kDeeper;
        keep_[i].push_back(std::min(radius - hazard.allowance, now) - deeper);
      }
    }
  }

  bool allows(const Velocity& command) const {
    for (std::size_t i = 0; i < starts_.size() && !hazards_.empty(); ++i) {
      const auto path = pathOf(starts_[i], command);
      for (std::size_t k = 0; k < hazards_.size(); ++k) {
        if (nearest(path, hazards_[k]) < keep_[i][k]) return false;
      }
    }
    return true;
  }

 private:
  StoppingPath pathOf(const PredictedState& start, const Velocity& command) const {
    return stoppingPath(start, command, turns_faster_, brakes_, period_);
  }

  std::vector<PredictedState> starts_;
  std::vector<Hazard> hazards_;
  std::vector<std::vector<double>> keep_;  ///< m, by start: how near to each hazard it may come
  double turns_faster_, period_;
  Velocity brakes_;
};

}  // namespace

Velocity velocityTowards(const Eigen::Vector2d& target_robot, bool stop_at_target,
                         const RobotParameters& robot) {
  const double distance = target_robot.norm();
  if (distance == 0.0) return {};
  const double bearing = std::atan2(target_robot.y(), target_robot.x());
  const double turn = std::abs(bearing);
  Velocity velocity;
  // The turning rate must be able to fall to zero by the time the bearing does.
  const double braking = std::sqrt(robot.max_angular_acceleration * turn);
  const double rate = std::min({kTurningGain * turn, braking, robot.max_angular_velocity});
  velocity.angular = std::copysign(rate, bearing);
  if (turn >= kTurnOnTheSpot) return velocity;
  velocity.linear = robot.max_linear_velocity * (1.0 - turn / kTurnOnTheSpot);
  // A target close by must not be circled: v / w stays below the arc that leads there.
  if (turn > 0.05) {
    velocity.linear = std::min(velocity.linear, rate * 0.5 * distance / std::sin(turn));
  }
  if (stop_at_target) {
    velocity.linear =
        std::min(velocity.linear, std::sqrt(2.0 * 0.7 * robot.max_linear_acceleration * distance));
  }
  return velocity;
}

double bearingPast(const std::vector<Hazard>& hazards, double radius, double bearing) {
  std::vector<double> bearings;  // of those that are too near
  for (const Hazard& hazard : hazards) {
    if (hazard.p_robot.norm() >= radius - hazard.allowance) continue;
    bearings.push_back(std::atan2(hazard.p_robot.y(), hazard.p_robot.x()));
  }
  const auto isPast = [&](double direction) {
    return std::all_of(bearings.begin(), bearings.end(), [&](double towards) {
      return std::abs(wrapAngle(direction - towards)) > 0.5 * M_PI;
    });
  };
  if (isPast(bearing)) return bearing;
  double best = bearing, least = std::numeric_limits<double>::infinity();
  for (const double towards : bearings) {
    for (const double aside : {-kPastHazard, kPastHazard}) {
      const double off = std::abs(wrapAngle(towards + aside - bearing));
      if (off >= least || !isPast(towards + aside)) continue;
      least = off;
      best = towards + aside;
    }
  }
  return best;
}

Velocity safeVelocity(const Velocity& wanted, const Velocity& present,
                      const std::vector<Hazard>& hazards, const RobotParameters& robot,
                      double radius, double period, const Velocity& brakes,
                      const std::vector<PredictedState>& others) {
  const ReachableVelocities reachable{present, robot, period};
  std::vector<PredictedState> starts{{{}, present, 0.0}};
  starts.insert(starts.end(), others.begin(), others.end());
  const double fastest = present.linear + robot.max_linear_acceleration * period;
  const StoppingCheck check(std::move(starts),
                            hazardsInReach(hazards, fastest, radius, period, brakes, others), robot,
                            radius, period, brakes, reachable.nearestTo(0.0, 0.0));
  const Velocity first = reachable.nearestTo(wanted.linear, wanted.angular);
  if (check.allows(first)) return first;
  Velocity best = reachable.nearestTo(0.0, 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (double speed : {1.0, 0.75, 0.5, 0.25, 0.1, 0.0}) {
    for (double turn : {0.0, 0.25, -0.25, 0.5, -0.5, 1.0, -1.0}) {
      const double w = speed == 0.0 && turn == 0.0
                           ? wanted.angular
                           : wanted.angular * speed + turn * robot.max_angular_velocity;
      const Velocity candidate = reachable.nearestTo(first.linear * speed, w);
      const double cost = std::abs(candidate.linear - first.linear) / robot.max_linear_velocity +
                          std::abs(candidate.angular - wanted.angular) / robot.max_angular_velocity;
      if (cost >= least || !check.allows(candidate)) continue;
      least = cost;
      best = candidate;
    }
  }
  return best;
}

}  // namespace cca
