// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/velocity_controller.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "navigation/control/motion_control.hpp"
#include "sensing/beam.hpp"
#include "sensing/near_surfaces.hpp"

namespace cca {
namespace {

constexpr double kWalkingSpeed = 1.0;  // m/s, of what moves, in any direction
constexpr double kAmongMovers = 0.45;  // m/s, where somebody may come around the corner
constexpr std::array<double, 3> kLookAhead{-0.2, 0.0, 0.2};  // rad: a disc of 25 cm, 1.2 m ahead
constexpr std::size_t kLately = 5;  // scans; by the last one alone crowded places are seen to .95
constexpr double kPreciseSigma = 0.006;  // m; the clearance allows for as much
// m, beside the robot. Ways are planned around obstacle points that are thinned; from a corner that
// this leaves out, the robot keeps no more than what may hide between two beams. What one scan
// reads too far the next one corrects, but not where commands act late.
constexpr double kBetweenBeams = 0.004;
// s, that a robot is held by what it is too near to, and that it then drives past it instead of
// straight to its target. In passages of its own width it would turn to and fro between the walls.
constexpr double kHeld = 1.0, kGettingAway = 3.0;
// Two people who cannot pass one another and the robot behind them would wait for one another for
// ever. Who has stood within reach of a standing robot for longer than people pause has seen it:
// the robot then creeps past, reckoning with a step aside instead of a walk. Not one whose commands
// act late: of 20 drives among walkers who see nothing four then touched one, else 2 of 280.
constexpr double kStoodLong = 5.0;    // s; people pause for two, kMemory is three
constexpr double kCreepsPast = 4.0;   // s, 40 cm: past a body. Then it waits anew.
constexpr double kCreeping = 0.1;     // m/s; it stands again within 1 cm
constexpr double kStepAside = 0.2;    // m/s, of who has stood there
constexpr double kWithinReach = 1.0;  // m; from farther off a walker still counts as one
constexpr double kTooNear = 0.1;      // m, from the hull: who comes so near has not seen the robot,
constexpr double kUnseen = 60.0;      // s; nor will others: movers are reckoned with as long

Eigen::Vector2d past(const std::vector<Hazard>& hazards, double radius,
                     const Eigen::Vector2d& target_robot) {
  const double bearing = std::atan2(target_robot.y(), target_robot.x());
  return Eigen::Rotation2Dd(bearingPast(hazards, radius, bearing) - bearing) * target_robot;
}

// Whether at least one of three beams around the heading is valid.
bool seesWhereItGoes(const LocalView& view, const Pose2& T) {
  return std::any_of(kLookAhead.begin(), kLookAhead.end(), [&](double bearing) {
    const Eigen::Vector2d ahead(std::cos(T.theta + bearing), std::sin(T.theta + bearing));
    return view.seenDistanceTowards(T.position() + 2.0 * ahead) > 0.0;
  });
}

}  // namespace

Velocity VelocityController::step(const std::optional<ControlTarget>& target,
                                  const Velocity& velocity, const LocalView& view,
                                  const MovingPoints& movers, double clearance, double heeded,
                                  double time) {
  motion_.observe(velocity, time);
  const PredictedState state = motion_.expected();
  const std::vector<Hazard> near = hazards(view, state, movers, clearance, time);
  Velocity wish = wanted(target, view, view.T_map_robot * state.T_now_then, near, clearance, time);
  if (movers.areAround(time)) wish.linear = std::min(wish.linear, kAmongMovers);
  if (time < creeps_past_until_) wish.linear = std::min(wish.linear, kCreeping);
  std::vector<PredictedState> others;
  for (const PredictedState& other : motion_.latencyHypotheses()) {
    others.push_back(
        {state.T_now_then.inverse() * other.T_now_then, other.velocity, other.delay - state.delay});
  }
  const Velocity command =
      safeVelocity(wish, state.velocity, near, motion_.robot(), clearance, motion_.period(),
                   motion_.actuation().reliableBrakes(), others);
  motion_.note(command);
  const bool stands = velocity.linear < kStands && wish.linear > 0.0;
  noteWhetherHeld(stands && command.linear == 0.0, time);
  noteWhetherPeopleStand(stands && command.linear < kStands && motion_.actsAtOnce(),
                         movers.distanceTo(view.T_map_robot.position()), time);
  remember(view, heeded);
  return command;
}

void VelocityController::noteSent(const Velocity& command, const Velocity& velocity, double time) {
  if (time != motion_.time()) motion_.observe(velocity, time);
  motion_.note(command);
}

Velocity VelocityController::wanted(const std::optional<ControlTarget>& target,
                                    const LocalView& view, const Pose2& T_map_robot,
                                    const std::vector<Hazard>& hazards, double clearance,
                                    double time) const {
  if (!target || view.horizon == 0.0) return {};
  Eigen::Vector2d target_robot = T_map_robot.inverse() * target->p_map;
  if (time < gets_away_until_) target_robot = past(hazards, clearance, target_robot);
  Velocity wish = velocityTowards(target_robot, target->stop_there, motion_.believed());
  if (!seesWhereItGoes(view, T_map_robot)) wish.linear = 0.0;
  return wish;
}

// In the frame of the robot when the command begins to act.
std::vector<Hazard> VelocityController::hazards(const LocalView& view, const PredictedState& state,
                                                const MovingPoints& movers, double clearance,
                                                double time) const {
  const auto inRobot = transformBy((view.T_map_robot * state.T_now_then).inverse());
  std::vector<Hazard> hazards;
  hazards.reserve(view.obstacles.size() + view.returns.size() + view.movers.size());
  const double allowance =
      motion_.actsAtOnce() ? clearance - motion_.robot().radius - kBetweenBeams : 0.0;
  for (const Eigen::Vector2d& p_map : view.obstacles) hazards.push_back({inRobot(p_map)});
  for (const Eigen::Vector2d& p_map : view.returns) {
    hazards.push_back({inRobot(p_map), 0.0, allowance});
  }
  for (const auto& points : lately_near_map_) {
    for (const Eigen::Vector2d& p_map : points) hazards.push_back({inRobot(p_map)});
  }
  for (const auto* points : {&view.movers, &movers.unsettled()}) {
    for (const Eigen::Vector2d& p_map : *points) {
      const Eigen::Vector2d p = inRobot(p_map);
      const bool has_stood = time < creeps_past_until_ && p.norm() < kWithinReach;
      const double speed = has_stood ? kStepAside : kWalkingSpeed;
      hazards.push_back({p, speed, -speed * state.delay});
    }
  }
  return hazards;
}

void VelocityController::noteWhetherHeld(bool is_held, double time) {
  if (is_held) {
    held_.run(time);
  } else {
    held_.stop();
  }
  if (held_.isOver(kHeld, time)) gets_away_until_ = time + kGettingAway;
}

void VelocityController::noteWhetherPeopleStand(bool is_held, double nearest_mover, double time) {
  const double too_near = motion_.robot().radius + kTooNear;
  if (nearest_mover < too_near) {
    creeps_past_until_ = time;
    unseen_until_ = time + kUnseen;
  }
  if (is_held && nearest_mover < kWithinReach && time > unseen_until_) {
    people_stand_.run(time);
  } else {
    people_stand_.stop();
  }
  if (people_stand_.isOver(kStoodLong, time)) creeps_past_until_ = time + kCreepsPast;
}

// Where ranges are noisy, one scan that reads far must not be enough to go a step nearer: a robot
// that waits beside a wall would creep into it, scan by scan. Where they are noisier than usual,
// NearSurfaces sees to that.
void VelocityController::remember(const LocalView& view, double heeded) {
  if (lately_near_map_.size() >= kLately) lately_near_map_.pop_front();
  lately_near_map_.emplace_back();
  if (view.range_sigma < kPreciseSigma || view.range_sigma > NearSurfaces::kUsualSigma) return;
  const Eigen::Vector2d x = view.T_map_robot.position();
  for (const Eigen::Vector2d& p_map : view.obstacles) {
    if ((p_map - x).norm() < heeded) lately_near_map_.back().push_back(p_map);
  }
}

}  // namespace cca
