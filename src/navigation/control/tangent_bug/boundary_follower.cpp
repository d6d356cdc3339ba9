// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/boundary_follower.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {
namespace {

constexpr double kArc = 20.0 * M_PI / 180.0;  // rad, between two points of a trace
constexpr double kRounding = 1e-6;            // rad; contacts nearer to each other are one
constexpr int kMostContacts =
    2000;  // 40 m of boundary at 2 cm; ends a trace that rounding keeps alive

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

constexpr double kTolerance = 0.2;  // m, below the robot's width: not the wall's other side
// m, walked twice: seen from all of the loop; less than once around a single point.
constexpr double kOverlap = 0.8;
constexpr double kTurnTolerance =
    0.8;  // rad, of the whole turn; the boundary is seen anew each time

constexpr double kTracedAhead = 4.0;  // m, traced in front of the robot
constexpr double kSensed = 8.0;       // m, traced each way for the first d_followed
// m: a boundary moves less from one step to the next; as far ahead is past a usual robot's hull.
constexpr double kHull = 0.3;
constexpr double kHidden = 0.1;  // m, beyond what a beam sees

bool isInSight(const LocalView& view, const Eigen::Vector2d& p_map) {
  const double distance = (p_map - view.T_map_sensor.position()).norm();
  return distance <= view.seenDistanceTowards(p_map) + kHidden + 2.0 * view.range_sigma;
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

void LoopDetector::add(const Eigen::Vector2d& p_map, double length, double heading) {
  const bool again = std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    const double turned = std::abs(heading - place.heading);
    return length - place.length >= kOverlap && std::abs(turned - 2.0 * M_PI) <= kTurnTolerance &&
           (p_map - place.p_map).norm() <= kTolerance;
  });
  if (again && again_since_ < 0.0) again_since_ = length;
  if (!again) again_since_ = -1.0;
  closed_ = closed_ || (again && length - again_since_ >= kOverlap);
  // No farther apart than half of the tolerance: between two places none is missed.
  if (places_.empty() || 2.0 * (length - places_.back().length) >= kTolerance) {
    places_.push_back({p_map, length, heading});
  }
}

void BoundaryFollower::start(const Eigen::Vector2d& start_map, bool on_the_right,
                             const Eigen::Vector2d& goal_map, const LocalView& view,
                             const ConfigurationSpace& space) {
  *this = {};
  on_the_right_ = on_the_right;
  d_followed_ = INFINITY;
  least_reach_ = INFINITY;
  const auto seen = [&](const Eigen::Vector2d& p_map) { return isInSight(view, p_map); };
  include(traceBoundary(space, start_map, !on_the_right, kSensed, seen), goal_map);
  trace_ = traceBoundary(space, start_map, on_the_right, kSensed, seen);
  include(trace_, goal_map);
  include(start_map, goal_map);
  heading_ = trace_.empty() ? 0.0 : trace_.front().heading;
}

std::optional<Eigen::Vector2d> BoundaryFollower::step(const Eigen::Vector2d& goal_map,
                                                      const LocalView& view,
                                                      const ConfigurationSpace& trace_space,
                                                      const ConfigurationSpace& way_space,
                                                      double d_reach) {
  const Eigen::Vector2d x = view.T_map_robot.position();
  const auto seen = [&](const Eigen::Vector2d& p_map) { return isInSight(view, p_map); };
  // Out of sight, the boundary beside the robot is the one that it has been following.
  const bool found = findAnchor(view, trace_space);
  auto trace = traceBoundary(trace_space, found ? trace_[anchor_].center_map : x, on_the_right_,
                             closely_ ? 2.0 * kHull : kTracedAhead, seen);
  if (trace.empty() || (!found && (trace.front().center_map - x).norm() > kBeside)) {
    return std::nullopt;
  }
  trace_ = std::move(trace);
  include(trace_, goal_map);
  noteNarrowPlace();
  std::size_t target = trace_.size() - 1;
  while (target > 0 && !way_space.isFree(x, trace_[target].center_map)) --target;
  moveAnchor(x, goal_map, target);
  least_reach_ = std::min(least_reach_, d_reach);
  if (loop_.closed() && !lookedAtNearest() && !closely_) {
    closely_ = true;
    loop_.reset();
  }
  return trace_[target].center_map;
}

// The first place of the last trace, from the anchor on, that the present scan shows as a boundary.
bool BoundaryFollower::findAnchor(const LocalView& view, const ConfigurationSpace& space) {
  for (std::size_t i = anchor_; i < trace_.size(); ++i) {
    const Eigen::Vector2d& p = trace_[i].center_map;
    if (!isInSight(view, p) || std::abs(space.clearance(p) - space.radius) > kHull) continue;
    length_ += trace_[i].length - trace_[anchor_].length;
    heading_ += trace_[i].heading - trace_[anchor_].heading;
    anchor_ = i;
    return true;
  }
  return false;
}

void BoundaryFollower::noteNarrowPlace() {
  for (const BoundaryPoint& point : trace_) {
    if (point.length < kHull) continue;
    const double turn = (point.heading - trace_.front().heading) * (on_the_right_ ? -1.0 : 1.0);
    if (!narrow_map_ || turn > narrow_turn_) {
      narrow_map_ = point.center_map;
      narrow_turn_ = turn;
    }
    return;
  }
}

bool BoundaryFollower::lookedAtNearest() const { return least_reach_ < d_followed_ + kTolerance; }

bool BoundaryFollower::hasLooped() const {
  return loop_.closed() && (lookedAtNearest() || closely_);
}

std::optional<Eigen::Vector2d> BoundaryFollower::takeNarrowPlace() {
  const auto place = narrow_map_;
  narrow_map_.reset();
  return place;
}

// Around the last point in sight the disc only seems to turn: what lies behind it is not known yet.
void BoundaryFollower::include(const std::vector<BoundaryPoint>& trace,
                               const Eigen::Vector2d& goal_map) {
  for (const BoundaryPoint& point : trace) {
    if (point.obstacle != trace.back().obstacle) include(point.center_map, goal_map);
  }
}

void BoundaryFollower::include(const Eigen::Vector2d& p_map, const Eigen::Vector2d& goal_map) {
  const double distance = (p_map - goal_map).norm();
  d_followed_ = std::min(d_followed_, distance);
}

// To the trace's place nearest to the robot, up to the target.
void BoundaryFollower::moveAnchor(const Eigen::Vector2d& x_map, const Eigen::Vector2d& goal_map,
                                  std::size_t last) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i <= last; ++i) {
    if ((trace_[i].center_map - x_map).norm() < (trace_[nearest].center_map - x_map).norm()) {
      nearest = i;
    }
  }
  // The trace is made anew each time: its first heading joins the walk's.
  heading_ += wrapAngle(trace_.front().heading - heading_);
  for (std::size_t i = 0; i <= nearest; ++i) {
    include(trace_[i].center_map, goal_map);
    loop_.add(trace_[i].center_map, length_ + trace_[i].length,
              heading_ + trace_[i].heading - trace_.front().heading);
  }
  anchor_ = nearest;
  if (trace_[nearest].length > kHull) narrow_map_.reset();
  length_ += trace_[nearest].length;
  heading_ += trace_[nearest].heading - trace_.front().heading;
}

}  // namespace cca
