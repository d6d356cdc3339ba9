// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/movers.hpp"

#include <cmath>

namespace cca {

namespace {

constexpr double kPatience = 2.0;      // s before a robot in the way, then it turns
constexpr double kMeanStraight = 4.0;  // s between turns of a random walk
constexpr double kArrived = 0.05;      // m from a way-point

bool isRandomWalk(const Mover& mover) { return mover.way_points.size() < 2; }

}  // namespace

Movers::Movers(const std::vector<Mover>& movers, std::uint64_t seed) {
  for (const Mover& mover : movers) {
    walks_.push_back({mover, Random(seed + walks_.size())});
    bodies_.push_back(mover.body);
    if (isRandomWalk(mover)) turnAway(walks_.back());
  }
}

double Movers::headingOf(const Walk& walk, const Body& body) const {
  if (isRandomWalk(walk.mover)) return walk.heading;
  const Eigen::Vector2d way = walk.mover.way_points[walk.next] - body.T_map_body.position();
  return std::atan2(way.y(), way.x());
}

void Movers::turnAway(Walk& walk) const {
  walk.blocked = 0.0;
  if (isRandomWalk(walk.mover)) {
    walk.heading = walk.random.uniform(-M_PI, M_PI);
    return;
  }
  const std::size_t count = walk.mover.way_points.size();
  walk.forwards = !walk.forwards;
  if (walk.mover.loop) {
    walk.next = (walk.next + (walk.forwards ? 1 : count - 1)) % count;
  } else {
    walk.next = walk.forwards ? walk.next + 1 : walk.next - 1;
  }
}

void Movers::passWayPoint(Walk& walk, const Eigen::Vector2d& p_map) const {
  if (isRandomWalk(walk.mover) || (walk.mover.way_points[walk.next] - p_map).norm() > kArrived) {
    return;
  }
  const std::size_t count = walk.mover.way_points.size();
  if (walk.mover.loop) {
    walk.next = (walk.next + (walk.forwards ? 1 : count - 1)) % count;
    return;
  }
  if (walk.next == 0) walk.forwards = true;
  if (walk.next + 1 == count) walk.forwards = false;
  walk.next += walk.forwards ? 1 : -1;
}

bool Movers::comesIntoAnother(std::size_t i, const Eigen::Vector2d& p_map) const {
  const Eigen::Vector2d x = bodies_[i].T_map_body.position();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (k == i) continue;
    const Eigen::Vector2d other = bodies_[k].T_map_body.position();
    const double apart = (p_map - other).norm();
    // Two that began in one place may part.
    if (apart < bodies_[i].radius() + bodies_[k].radius() && apart < (x - other).norm()) {
      return true;
    }
  }
  return false;
}

int Movers::advance(const World& world, const Eigen::Vector2d& p_robot, double robot_radius,
                    double dt) {
  int contacts = 0;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    Walk& walk = walks_[i];
    Body& body = bodies_[i];
    passWayPoint(walk, body.T_map_body.position());
    if (isRandomWalk(walk.mover) && walk.random.uniform() < dt / kMeanStraight) turnAway(walk);
    Body next = body;
    next.T_map_body.theta = headingOf(walk, body);
    const Eigen::Vector2d p =
        body.T_map_body.position() + walk.mover.speed * dt * next.T_map_body.heading();
    next.T_map_body.x = p.x();
    next.T_map_body.y = p.y();
    if (world.clearance(p, body.radius()) < body.radius() || comesIntoAnother(i, p)) {
      turnAway(walk);
      continue;
    }
    const double room = distance(next, p_robot) - robot_radius;
    const bool nearer = room < distance(body, p_robot) - robot_radius;
    const bool touches = nearer && room < 0.0 && walk.mover.gap <= 0.0;
    if (touches && !walk.touching) ++contacts;
    walk.touching = touches || (walk.touching && room < 0.05);
    if (touches || (nearer && room < walk.mover.gap)) {
      walk.blocked += dt;
      if (walk.blocked > kPatience) turnAway(walk);
      continue;
    }
    walk.blocked = 0.0;
    body = next;
  }
  return contacts;
}

}  // namespace cca
