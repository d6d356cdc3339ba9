// SPDX-License-Identifier: BSD-3-Clause
#include "motion/commanded_motion.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

double towards(double from, double to, double speeds_up, double brakes, double dt) {
  const bool falls = from * (to - from) < 0.0;
  const double most = (falls ? brakes : speeds_up) * dt;
  const double next = from + std::clamp(to - from, -most, most);
  return falls && next * from < 0.0 && to * from < 0.0 ? 0.0 : next;
}

constexpr double kLongestGap = 0.3;  // s; between readings farther apart anything may have happened
constexpr double kSubstep = 0.0125;  // s, half of what latencies differ by
constexpr Velocity kError{0.02, 0.05};  // m/s, rad/s: the deviation of a usual odometry's velocity
constexpr double kResponse = 3.0;       // kError: a change of this much is no noise, at three sigma
constexpr double kChance = 9.0;         // three sigma, squared: what fits worse is not by chance
constexpr double kAsGood = 0.1;   // squares of kError: shares that fit within this fit equally well
constexpr double kForget = 0.99;  // of the sums, an observation
constexpr double kLongestPending = 0.7;  // s, longer than any latency that is learned
constexpr double kReliable = 0.5;        // of the linear brakes that are told

constexpr double kOverSpeed = 1.5;     // of full speed: what says more is broken
constexpr double kSameLatency = 0.05;  // s: half a control period

constexpr double kShortestPeriod = 0.1, kLongestPeriod = 1.0;  // s; slower, nobody drives by it
constexpr double kStampRounding = 1e-6;  // s: stamps of microseconds make no interval longer
constexpr std::size_t kIntervals = 5;    // between commands; their median bears two that are odd

}  // namespace

void SentCommands::add(const Velocity& command, double time) {
  if (!std::isfinite(command.linear + command.angular + time)) return;
  const bool is_alone =
      !sent_.empty() && !(time >= sent_.back().time && time <= sent_.back().time + kKept);
  if (is_alone) sent_.clear();
  if (!sent_.empty() && sent_.back().time == time) sent_.pop_back();
  sent_.push_back({time, command});
  while (sent_.size() > 1 && sent_[1].time < time - kKept) sent_.pop_front();
}

std::optional<Velocity> SentCommands::at(double time) const {
  const auto later = std::upper_bound(sent_.begin(), sent_.end(), time,
                                      [](double t, const Sent& sent) { return t < sent.time; });
  if (later == sent_.begin()) return std::nullopt;
  return std::prev(later)->command;
}

Velocity obey(const Velocity& velocity, const Velocity& command, const Velocity& speeds_up,
              const Velocity& brakes, double dt) {
  return {towards(velocity.linear, command.linear, speeds_up.linear, brakes.linear, dt),
          towards(velocity.angular, command.angular, speeds_up.angular, brakes.angular, dt)};
}

ActuationModel::ActuationModel(const RobotParameters& robot) : robot_(robot) { conclude(); }

void ActuationModel::changeMotion(const RobotParameters& robot) {
  const bool obeys_otherwise = robot.latency != robot_.latency ||
                               robot.max_linear_acceleration != robot_.max_linear_acceleration ||
                               robot.max_angular_acceleration != robot_.max_angular_acceleration;
  if (obeys_otherwise) *this = ActuationModel(robot);
  robot_ = robot;
}

void ActuationModel::observe(const SentCommands& sent, const Velocity& measured, double time) {
  if (!std::isfinite(measured.linear + measured.angular + time)) return last_.reset();
  const double passed = time - last_time_;
  const bool follows = last_ && passed > 0.0 && passed <= kLongestGap;
  if (!follows) beginPending(measured, time);
  if (follows && sent.at(last_time_ - kStep * kLatencies)) {
    addErrors(sent, measured, time);
    const bool responds =
        std::abs(measured.linear - pending_from_.linear) > kResponse * kError.linear ||
        std::abs(measured.angular - pending_from_.angular) > kResponse * kError.angular;
    if (responds) takePending();
    if (responds || time - pending_since_ > kLongestPending) beginPending(measured, time);
  }
  last_ = measured;
  last_time_ = time;
}

void ActuationModel::beginPending(const Velocity& measured, double time) {
  pending_ = {};
  pending_count_ = 0.0;
  pending_since_ = time;
  pending_from_ = measured;
}

void ActuationModel::takePending() {
  for (std::size_t latency = 0; latency < kLatencies; ++latency) {
    for (std::size_t motion = 0; motion < kMotions; ++motion) {
      for (std::size_t share = 0; share < kShares; ++share) {
        double& sum = sums_[latency][motion][share];
        sum = kForget * sum + pending_[latency][motion][share];
      }
    }
  }
  count_ = kForget * count_ + pending_count_;
  conclude();
}

void ActuationModel::addErrors(const SentCommands& sent, const Velocity& measured, double time) {
  const int steps = std::max(1, static_cast<int>(std::lround((time - last_time_) / kSubstep)));
  const double dt = (time - last_time_) / steps;
  for (std::size_t latency = 0; latency < kLatencies; ++latency) {
    std::array<Velocity, kShares> velocities;
    velocities.fill(*last_);
    Velocity mean{};
    for (int i = 0; i < steps; ++i) {
      const double sent_by = last_time_ + (i + 0.5) * dt - static_cast<double>(latency) * kStep;
      const Velocity command = *sent.at(sent_by);
      mean.linear += command.linear / steps;
      mean.angular += command.angular / steps;
      for (std::size_t share = 0; share < kShares; ++share) {
        const Velocity most{kShare[share] * robot_.max_linear_acceleration,
                            kShare[share] * robot_.max_angular_acceleration};
        velocities[share] = obey(velocities[share], command, most, most, dt);
      }
    }
    const bool brakes = std::abs(mean.linear) < std::abs(last_->linear);
    const bool turns_less = std::abs(mean.angular) < std::abs(last_->angular);
    auto& drives = pending_[latency][brakes ? kBrakes : kDrivesFaster];
    auto& turns = pending_[latency][turns_less ? kTurnsLess : kTurnsFaster];
    for (std::size_t share = 0; share < kShares; ++share) {
      const double linear = (velocities[share].linear - measured.linear) / kError.linear;
      const double angular = (velocities[share].angular - measured.angular) / kError.angular;
      drives[share] += linear * linear;
      turns[share] += angular * angular;
    }
  }
  pending_count_ += 2.0;
}

double ActuationModel::sumOf(std::size_t latency) const {
  double sum = 0.0;
  for (const auto& motion : sums_[latency]) sum += *std::min_element(motion.begin(), motion.end());
  // What is far from what was told has to be shown.
  const double off = std::abs(static_cast<double>(latency) * kStep - robot_.latency);
  return off > kUnsure + 1e-9 ? sum + 2.0 * kChance : sum;
}

void ActuationModel::conclude() {
  best_ = static_cast<std::size_t>(std::lround(robot_.latency / kStep));
  for (std::size_t latency = 0; latency < kLatencies; ++latency) {
    if (sumOf(latency) < sumOf(best_) - 1e-9) best_ = latency;
  }
  const double least = sumOf(best_);
  const double most = least + kChance * std::max(1.0, least / std::max(count_, 1.0));
  std::size_t first = best_, last = best_;
  for (std::size_t latency = 0; latency < kLatencies; ++latency) {
    if (sumOf(latency) > most) continue;
    first = std::min(first, latency);
    last = std::max(last, latency);
  }
  latency_ = static_cast<double>(best_) * kStep;
  earliest_ = static_cast<double>(first) * kStep;
  latest_ = static_cast<double>(last) * kStep;
}

// Where the robot has not braked so hard, several are as good: then the hardest.
double ActuationModel::shareOf(Motion motion) const {
  const auto& sums = sums_[best_][motion];
  const double most = *std::min_element(sums.begin(), sums.end()) + kAsGood;
  const auto hardest =
      std::find_if(sums.begin(), sums.end(), [most](double sum) { return sum <= most; });
  return kShare[static_cast<std::size_t>(hardest - sums.begin())];
}

Velocity ActuationModel::brakes() const {
  return {shareOf(kBrakes) * robot_.max_linear_acceleration,
          shareOf(kTurnsLess) * robot_.max_angular_acceleration};
}

Velocity ActuationModel::reliableBrakes() const {
  Velocity reliable = brakes();
  reliable.linear = std::min(reliable.linear, kReliable * robot_.max_linear_acceleration);
  return reliable;
}

void CommandedMotion::observe(const Velocity& measured, double time) {
  const bool can_be = std::abs(measured.linear) < kOverSpeed * robot().max_linear_velocity &&
                      std::abs(measured.angular) < kOverSpeed * robot().max_angular_velocity;
  if (can_be) {
    actuation_.observe(sent_, measured, time);
    measured_ = measured;
  }
  if (time_ >= 0.0) intervals_.push_back(time - time_);
  if (intervals_.size() > kIntervals) intervals_.pop_front();
  time_ = time;
}

double CommandedMotion::period() const {
  double longest = kShortestPeriod;
  for (const double interval : intervals_) longest = std::max(longest, interval - kStampRounding);
  return std::min(longest, kLongestPeriod);
}

PredictedState CommandedMotion::after(double latency) const {
  PredictedState state{{}, measured_, latency};
  const int steps = static_cast<int>(std::ceil(latency / kSubstep - 1e-9));
  const double dt = latency / std::max(steps, 1);
  const Velocity speeds_up{robot().max_linear_acceleration, robot().max_angular_acceleration};
  const Velocity brakes = actuation_.brakes();
  for (int i = 0; i < steps; ++i) {
    const auto command = sent_.at(time_ + (i + 0.5) * dt - latency);
    const Velocity before = state.velocity;
    if (command) state.velocity = obey(before, *command, speeds_up, brakes, dt);
    const double way = 0.5 * (before.linear + state.velocity.linear) * dt;
    const double turn = 0.5 * (before.angular + state.velocity.angular) * dt;
    state.T_now_then =
        state.T_now_then * Pose2{way * std::cos(0.5 * turn), way * std::sin(0.5 * turn), turn};
  }
  return state;
}

std::vector<PredictedState> CommandedMotion::latencyHypotheses() const {
  std::vector<PredictedState> states;
  for (const double latency :
       {actuation_.earliest(), std::max(robot().latency, actuation_.latest())}) {
    if (std::abs(latency - this->latency()) > kSameLatency) states.push_back(after(latency));
  }
  return states;
}

bool CommandedMotion::actsAtOnce() const { return latency() <= kSameLatency; }

RobotParameters CommandedMotion::believed() const {
  RobotParameters believed = robot();
  const Velocity brakes = actuation_.brakes();
  believed.max_linear_acceleration = brakes.linear;
  believed.max_angular_acceleration = brakes.angular;
  return believed;
}

}  // namespace cca
