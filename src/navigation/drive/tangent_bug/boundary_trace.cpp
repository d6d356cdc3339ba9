// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/boundary_trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cca_mrpt/mapping/pose2.hpp"

namespace cca {
namespace {

constexpr double kArc = 20.0 * M_PI / 180.0;  // rad, between two points of a trace
constexpr double kRounding = 1e-6;            // rad
constexpr int kMostContacts = 2000;

int nearestObstacle(const ConfigurationSpace& space, const Eigen::Vector2d& p_map) {
  int nearest = -1;
  double least = INFINITY;
  for (std::size_t i = 0; i < space.obstacles.size(); ++i) {
    const double squared = (space.obstacles[i] - p_map).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

// The disc's next contact, turning around `contact` from `angle`; `sign` +1 counter-clockwise.
struct Contact {
  int obstacle = -1;
  double turn = 2.0 * M_PI;  // rad, around the present contact; below 0 out of an overlap
  double corner = 0.0;       // rad, by which the heading changes there, against the turn
};

Contact nextContact(const ConfigurationSpace& space, int contact, double angle, double sign) {
  const Eigen::Vector2d& p = space.obstacles[static_cast<std::size_t>(contact)];
  const double reach = 2.0 * space.radius;
  Contact next;
  for (std::size_t i = 0; i < space.obstacles.size(); ++i) {
    const Eigen::Vector2d to = space.obstacles[i] - p;
    const double squared = to.squaredNorm();
    if (squared >= reach * reach || squared == 0.0) continue;
    // Centres around p at angles within `half` of the bearing overlap the other disc.
    const double half = std::acos(std::sqrt(squared) / reach);
    const double off = sign * wrapAngle(std::atan2(to.y(), to.x()) - angle);
    double turn = off - half;
    if (std::abs(off) >= half - kRounding && turn < -kRounding) turn += 2.0 * M_PI;
    if (turn >= next.turn) continue;
    next = {static_cast<int>(i), turn, M_PI - 2.0 * half};
  }
  return next;
}

}  // namespace

std::vector<BoundaryPoint> traceBoundary(
    const ConfigurationSpace& space, const Eigen::Vector2d& start_map, bool on_the_right,
    double longest, const std::function<bool(const Eigen::Vector2d&)>& goes_on) {
  std::vector<BoundaryPoint> trace;
  int contact = nearestObstacle(space, start_map);
  if (contact < 0) return trace;
  // With the obstacle on its left, the disc rolls counter-clockwise around it.
  const double sign = on_the_right ? -1.0 : 1.0;
  const Eigen::Vector2d away = start_map - space.obstacles[static_cast<std::size_t>(contact)];
  double angle = std::atan2(away.y(), away.x());
  double heading = wrapAngle(angle + sign * M_PI_2);
  double length = 0.0;
  const auto add = [&] {
    const Eigen::Vector2d center = space.obstacles[static_cast<std::size_t>(contact)] +
                                   space.radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (!goes_on(center)) return false;
    trace.push_back({center, contact, length, heading});
    return true;
  };
  for (int contacts = 0; contacts < kMostContacts && length < longest; ++contacts) {
    const Contact next = nextContact(space, contact, angle, sign);
    if (next.turn >= 0.0 && !add()) break;
    for (double left = next.turn; left != 0.0;) {
      const double part = std::min(left, kArc);
      left -= part;
      angle = wrapAngle(angle + sign * part);
      heading += sign * part;
      length += space.radius * std::abs(part);
      if (left > 0.0 && !add()) return trace;
    }
    if (next.obstacle < 0) continue;  // alone: around it once more
    contact = next.obstacle;
    angle = wrapAngle(angle - sign * next.corner);
    heading -= sign * next.corner;
  }
  return trace;
}

}  // namespace cca
