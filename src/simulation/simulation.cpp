// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/simulation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "simulation/laser.hpp"
#include "simulation/movers.hpp"
#include "simulation/random.hpp"
#include "simulation/robot.hpp"

namespace cca {

namespace {

constexpr double kLongestStep = 0.01;  // s, of the integration
constexpr double kContactGap = 1e-7;   // m, rounding allowed in the contact test
constexpr double kContactOver = 0.01;  // m, a contact has ended this far from the obstacle
constexpr double kStanding = 0.02;     // m/s, below this the robot stands
constexpr double kRecordDistance = 0.05, kRecordTurn = 0.1;  // m, rad

// One seed, streams that do not disturb each other.
enum Stream : std::uint64_t { kLaserStream = 1, kOdometryStream = 2, kMoverStream = 3 };
std::uint64_t seedOf(std::uint64_t seed, Stream stream) {
  return seed * 0x9E3779B97F4A7C15ULL + stream;
}

}  // namespace

Simulation::Simulation(World world, const Pose2& T_map_start,
                       const SimulationParameters& parameters, const std::vector<Mover>& movers)
    : world_(std::move(world)),
      parameters_(parameters),
      movers_(std::make_unique<Movers>(movers, seedOf(parameters.seed, kMoverStream))),
      T_map_robot_(T_map_start),
      odometry_(std::make_unique<Odometry>(T_map_start, parameters.odometry,
                                           seedOf(parameters.seed, kOdometryStream))),
      laser_random_(std::make_unique<Random>(seedOf(parameters.seed, kLaserStream))) {
  const double radius = parameters.robot.radius;
  requireStandable(world_, T_map_start, radius);
  if (parameters.laser.range <= radius) {
    char text[120];
    std::snprintf(text, sizeof text,
                  "a laser of range %g m sees nothing beyond the robot's radius, %g m",
                  parameters.laser.range, radius);
    throw std::runtime_error(world_.name + ": " + text);
  }
  if (clearance(T_map_start.position(), radius) < radius) {
    throw std::runtime_error(world_.name + ": a mover stands at the robot's start");
  }
  record(true);
  remember();
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

const Pose2& Simulation::T_odom_robot() const { return odometry_->T_odom_robot(); }

const std::vector<Body>& Simulation::bodies() const { return movers_->bodies(); }

Observation Simulation::observe() {
  const double middle = time_ - 0.5 * std::abs(parameters_.laser.sweep);
  sweep_begun_ = instantAt(2.0 * middle - time_);
  scanned_ = instantAt(middle);
  const auto at = [&](double offset) {
    return LaserPlace{instantAt(middle + offset).T_map_robot, bodiesAt(middle + offset)};
  };
  Observation observation;
  observation.scan = sweep(world_, at, parameters_.laser, *laser_random_);
  observation.T_map_robot = scanned_.T_map_robot;
  observation.velocity = odometry_->show(velocity_);
  observation.time = scanned_.time;
  return observation;
}

SweepMotion Simulation::sweepMotion() const {
  if (parameters_.laser.sweep == 0.0) return {};
  const auto reading = [](const Instant& at) { return SensorReading{at.T_odom_robot, at.time}; };
  return {reading(scanned_), reading(sweep_begun_), SensorReading{T_odom_robot(), time_}};
}

void Simulation::remember() {
  const double sweep = std::abs(parameters_.laser.sweep);
  if (sweep == 0.0) return;
  past_.push_back({{time_, T_map_robot_, T_odom_robot()}, movers_->bodies()});
  while (past_.size() > 1 && past_[1].instant.time < time_ - sweep) past_.pop_front();
}

/// Between two steps of the integration; the robot stood before the first one.
Instant Simulation::instantAt(double time) const {
  if (past_.empty() || time >= time_) return {time_, T_map_robot_, T_odom_robot()};
  const auto after = std::find_if(past_.begin(), past_.end(),
                                  [time](const Past& past) { return past.instant.time >= time; });
  if (after == past_.begin()) {
    Instant first = after->instant;
    first.time = time;
    return first;
  }
  const Instant &a = std::prev(after)->instant, &b = after->instant;
  const double share = (time - a.time) / (b.time - a.time);
  return {time, poseBetween(a.T_map_robot, b.T_map_robot, share),
          poseBetween(a.T_odom_robot, b.T_odom_robot, share)};
}

const std::vector<Body>& Simulation::bodiesAt(double time) const {
  for (const Past& past : past_) {
    if (past.instant.time >= time) return past.bodies;
  }
  return movers_->bodies();
}

void Simulation::drive(const Velocity& command, double dt) {
  assert(dt >= 0.0 && std::isfinite(command.linear) && std::isfinite(command.angular));
  // Steps short enough that the disc cannot jump over an obstacle.
  const double longest_way = 0.4 * std::min(world_.resolution(), parameters_.robot.radius);
  const double fastest = parameters_.robot.max_linear_velocity;
  const double step = std::min(kLongestStep, longest_way / fastest);
  const int steps = std::max(1, static_cast<int>(std::ceil(dt / step - 1e-9)));
  const double start = time_;
  under_way_.push_back({start, command});
  for (int i = 1; i <= steps; ++i) {
    advance(heard(start + dt * (i - 0.5) / steps), dt / steps);
    moveOthers(dt / steps);
    time_ = start + dt * i / steps;
    remember();
    record(i == steps);
  }
}

Velocity Simulation::heard(double time) {
  const double sent_by = time - parameters_.robot.latency;
  while (under_way_.size() > 1 && under_way_[1].time <= sent_by) under_way_.pop_front();
  return under_way_.front().time <= sent_by ? under_way_.front().command : Velocity{};
}

void Simulation::advance(const Velocity& command, double dt) {
  const Velocity before = velocity_;
  velocity_ = approach(before, command, parameters_.robot, dt);
  Velocity mean{0.5 * (before.linear + velocity_.linear),
                0.5 * (before.angular + velocity_.angular)};
  Pose2 next = driveArc(T_map_robot_, mean, dt);
  const double radius = parameters_.robot.radius;
  const double gap = clearance(next.position(), radius + kContactOver);
  if (mean.linear != 0.0 && gap < radius - kContactGap) {
    if (!in_contact_) ++collisions_;
    in_contact_ = true;
    velocity_.linear = mean.linear = 0.0;  // a disc may still turn
    next = driveArc(T_map_robot_, mean, dt);
  } else if (in_contact_) {
    in_contact_ = gap < radius + kContactOver - kContactGap;
  }
  distance_ += std::abs(mean.linear) * dt;
  odometry_->add(mean, dt);
  T_map_robot_ = next;
}

void Simulation::moveOthers(double dt) {
  const int contacts =
      movers_->advance(world_, T_map_robot_.position(), parameters_.robot.radius, dt);
  const bool stands = std::abs(velocity_.linear) < kStanding;
  (stands ? mover_contacts_ : collisions_) += contacts;
}

double Simulation::clearance(const Eigen::Vector2d& p_map, double limit) const {
  double nearest = world_.clearance(p_map, limit);
  for (const Body& body : movers_->bodies())
    nearest = std::min(nearest, cca::distance(body, p_map));
  return nearest;
}

void Simulation::record(bool always) {
  if (!always) {
    const Pose2& last = trajectory_.back().T_map_robot;
    const double way = (T_map_robot_.position() - last.position()).norm();
    const double turn = std::abs(wrapAngle(T_map_robot_.theta - last.theta));
    if (way < kRecordDistance && turn < kRecordTurn) return;
  }
  trajectory_.push_back({time_, T_map_robot_});
}

}  // namespace cca
