// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/safe_velocity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cca_mrpt/mapping/pose2.hpp"

namespace cca {
namespace {

constexpr double kStep = 0.05;   // s, of the predicted motion
constexpr double kStill = 1e-9;  // m/s, rad/s
// m, by which a hazard may come nearer that is inside the clearance, and inside the robot itself: a
// robot that touches something only turns or leaves.
constexpr double kDeeper = 1e-4, kRounding = 1e-9;
constexpr double kAside = 0.5 * M_PI + 0.02;  // rad, from a hazard: past it

double towards(double from, double to, double step) {
  return from < to ? std::min(to, from + step) : std::max(to, from - step);
}

struct Predicted {
  Eigen::Vector2d p_robot;
  double time;
};

// The command for one period, then braking until it stands.
std::vector<Predicted> stoppingPath(const Velocity& present, const Velocity& command,
                                    const RobotParameters& robot, double period) {
  std::vector<Predicted> path;
  Pose2 pose;
  Velocity velocity = present;
  double time = 0.0;
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
  const Velocity first{std::max(present.linear, command.linear), command.angular};
  while (time < period - 1e-9) advance(first);
  velocity = {std::max(present.linear, command.linear), command.angular};
  while (velocity.linear > kStill || std::abs(velocity.angular) > kStill) {
    advance({towards(velocity.linear, 0.0, robot.max_linear_acceleration * kStep),
             towards(velocity.angular, 0.0, robot.max_angular_acceleration * kStep)});
  }
  return path;
}

bool isSafe(const std::vector<Predicted>& path, const std::vector<Hazard>& hazards, double radius,
            double robot_radius) {
  for (const Hazard& hazard : hazards) {
    const double start = hazard.p_robot.norm();
    const double keep =
        std::min(radius - hazard.allowance, start) - (start < robot_radius ? kRounding : kDeeper);
    for (const Predicted& at : path) {
      const double distance = (hazard.p_robot - at.p_robot).norm();
      if (distance - hazard.closing_speed * at.time < keep) return false;
    }
  }
  return true;
}

}  // namespace

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
    for (const double aside : {-kAside, kAside}) {
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
                      double radius, double period) {
  const double dv = robot.max_linear_acceleration * period;
  const double dw = robot.max_angular_acceleration * period;
  const auto reachable = [&](double v, double w) {
    v = std::clamp(v, 0.0, robot.max_linear_velocity);
    w = std::clamp(w, -robot.max_angular_velocity, robot.max_angular_velocity);
    return Velocity{towards(present.linear, v, dv), towards(present.angular, w, dw)};
  };
  std::vector<Hazard> near;
  const double v_max = std::max(present.linear + dv, 0.0);
  const double stopping_time = period + v_max / robot.max_linear_acceleration;
  const double stopping = v_max * period + 0.5 * v_max * v_max / robot.max_linear_acceleration;
  for (const Hazard& hazard : hazards) {
    const double reach = radius + stopping + hazard.closing_speed * stopping_time;
    if (hazard.p_robot.squaredNorm() < reach * reach) near.push_back(hazard);
  }
  const Velocity first = reachable(wanted.linear, wanted.angular);
  if (near.empty() ||
      isSafe(stoppingPath(present, first, robot, period), near, radius, robot.radius)) {
    return first;
  }
  Velocity best = reachable(0.0, 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (double speed : {1.0, 0.75, 0.5, 0.25, 0.1, 0.0}) {
    for (double turn : {0.0, 0.25, -0.25, 0.5, -0.5, 1.0, -1.0}) {
      const double w = speed == 0.0 && turn == 0.0
                           ? wanted.angular
                           : wanted.angular * speed + turn * robot.max_angular_velocity;
      const Velocity candidate = reachable(first.linear * speed, w);
      const double cost = std::abs(candidate.linear - first.linear) / robot.max_linear_velocity +
                          std::abs(candidate.angular - wanted.angular) / robot.max_angular_velocity;
      if (cost >= least) continue;
      if (!isSafe(stoppingPath(present, candidate, robot, period), near, radius, robot.radius))
        continue;
      least = cost;
      best = candidate;
    }
  }
  return best;
}

}  // namespace cca
