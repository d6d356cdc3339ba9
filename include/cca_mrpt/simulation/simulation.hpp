// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "cca_mrpt/navigation/observation.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"
#include "cca_mrpt/simulation/mover.hpp"
#include "cca_mrpt/simulation/parameters.hpp"
#include "cca_mrpt/simulation/world.hpp"

namespace cca {

class Movers;
class Odometry;
class Random;

/// A true pose on the robot's way.
struct TimedPose {
  double time = 0.0;  ///< s
  Pose2 T_map_robot;
};

/// Where the robot was, and believed to be by its wheels.
struct Instant {
  double time = 0.0;  ///< s
  Pose2 T_map_robot, T_odom_robot;
};

/// A round differential-drive robot with a laser at its centre, in a world.
///
/// The robot never enters an obstacle: contact stops it. Equal worlds, parameters and commands
/// give equal results, bit by bit.
class Simulation {
 public:
  /// @throws std::runtime_error where the robot cannot stand at the start, or its laser sees
  /// nothing
  ///         beyond it.
  Simulation(World world, const Pose2& T_map_start, const SimulationParameters& parameters,
             const std::vector<Mover>& movers = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  /// A new scan, whose sweep ends now, with the true pose in its middle and the velocity that the
  /// odometry shows now. Each call draws new noise.
  Observation observe();
  /// The middle of the last scan's sweep: now, where it was taken in an instant.
  const Instant& scanned() const { return scanned_; }
  /// By the wheels, of the last scan: at its begin, in the middle, and at its end, now. Nothing
  /// where the laser takes its scans in an instant.
  SweepMotion sweepMotion() const;

  /// Drives for dt seconds towards a commanded velocity, within the robot's limits. The base hears
  /// of the command when the robot's latency is over, and drives by the one before until then.
  void drive(const Velocity& command, double dt);

  double time() const { return time_; }           ///< s since the start
  double distance() const { return distance_; }   ///< m driven
  int collisions() const { return collisions_; }  ///< contacts the robot drove into
  /// Contacts that a mover drove into while the robot stood.
  int moverContacts() const { return mover_contacts_; }
  const Velocity& velocity() const { return velocity_; }     ///< true
  const Pose2& T_map_robot() const { return T_map_robot_; }  ///< true
  const Pose2& T_odom_robot() const;                         ///< starts at the start
  const World& world() const { return world_; }
  const std::vector<Body>& bodies() const;
  const SimulationParameters& parameters() const { return parameters_; }
  /// The true way so far: a pose at least every 5 cm or 6 degrees, and at the end of each drive().
  const std::vector<TimedPose>& trajectory() const { return trajectory_; }

 private:
  struct Past {
    Instant instant;
    std::vector<Body> bodies;
  };
  void remember();
  Instant instantAt(double time) const;
  const std::vector<Body>& bodiesAt(double time) const;

  struct Sent {
    double time;
    Velocity command;
  };

  Velocity heard(double time);
  void advance(const Velocity& command, double dt);
  void moveOthers(double dt);
  /// m, from a point to the nearest obstacle or mover, at most limit.
  double clearance(const Eigen::Vector2d& p_map, double limit) const;
  void record(bool always);

  World world_;
  SimulationParameters parameters_;
  std::unique_ptr<Movers> movers_;
  Pose2 T_map_robot_;
  Velocity velocity_;
  std::deque<Sent> under_way_;  ///< the first one is what the base acts on
  std::unique_ptr<Odometry> odometry_;
  std::unique_ptr<Random> laser_random_;
  std::deque<Past> past_;  ///< of the last sweep, where the laser has one
  Instant sweep_begun_, scanned_;
  double time_ = 0.0, distance_ = 0.0;
  int collisions_ = 0, mover_contacts_ = 0;
  bool in_contact_ = false;
  std::vector<TimedPose> trajectory_;
};

}  // namespace cca
