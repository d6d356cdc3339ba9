// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/motion_compensation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sensing/gates.hpp"

namespace cca {
namespace {

constexpr double kLongestGap = 0.5;  // s; the motion in between is not that during the sweep
constexpr std::size_t kPeriods = 31,
                      kLeastPeriods = 5;  // some seconds; a median of five bears two gaps
// Of a period or a duration: half of the periods lie so near to their median, no sweep is longer
// than a period by more, and what differs by more is another question to identification.
constexpr double kIrregular = 0.1;
constexpr double kShortest = 0.02;     // of the period: below, a driver's duration is nonsense
constexpr double kSlowestLaser = 1.0;  // s; no sweep lasts longer

Twist twistBetween(const SensorReading& before, const SensorReading& after) {
  return twistBetween(before.T_odom_sensor, after.T_odom_sensor, after.time - before.time);
}

/// Whether the sensor has moved from one to the other: soon, and as a robot drives. Odometry that
/// begins anew leaps.
bool follows(const SensorReading& before, const SensorReading& after) {
  if (!(after.time > before.time) || after.time - before.time > kLongestGap) return false;
  const Twist twist = twistBetween(before, after);
  return twist.linear.norm() < kFastest && std::abs(twist.angular) < kFastestTurn;
}

/// The mean twist from one time to another, by the last three readings: constant acceleration; none
/// of a single one.
Twist meanTwist(const std::vector<SensorReading>& readings, double from, double to) {
  const std::size_t n = readings.size();
  if (n < 2) return {};
  const SensorReading &b = readings[n - 2], &c = readings[n - 1];
  const Twist last = twistBetween(b, c);
  if (n < 3) return last;
  const SensorReading& a = readings[n - 3];
  const Twist first = twistBetween(a, b);
  // Each is that of the middle of its interval.
  const double share = (0.5 * (from + to) - 0.5 * (a.time + b.time)) / (0.5 * (c.time - a.time));
  return {first.linear + share * (last.linear - first.linear),
          first.angular + share * (last.angular - first.angular)};
}

}  // namespace

Scan MotionCompensation::undistort(const Scan& scan, const SweepMotion& motion) {
  const auto& now = motion.middle;
  if (!now || (!taken_.empty() && !follows(taken_.back().middle, *now))) taken_.clear();
  Scan swept = scan;
  swept.sweep_duration = duration_ = 0.0;
  undone_.reset();
  if (!now || scan.size() < 2) return swept;
  if (!taken_.empty()) periods_.push_back(now->time - taken_.back().middle.time);
  if (periods_.size() > kPeriods) periods_.pop_front();
  const double duration = told_ ? std::abs(*told_) : candidate(scan);
  const Taken taken{scan, *now, duration};
  if (!told_ && !is_repeating_) identify(taken);
  taken_.push_back(taken);
  if (taken_.size() > 3) taken_.pop_front();
  swept.sweep_duration = duration_ = told_ ? *told_ : signedDuration(scan, duration);
  std::vector<SensorReading> readings;
  for (const Taken& last : taken_) readings.push_back(last.middle);
  if (motion.before && follows(*motion.before, *now)) readings = {*motion.before, *now};
  if (motion.after && follows(*now, *motion.after)) readings.push_back(*motion.after);
  const double half = 0.5 * std::abs(duration_);
  const Twist before = meanTwist(readings, now->time - half, now->time);
  const Twist after = meanTwist(readings, now->time, now->time + half);
  if (isBent(swept, before, after)) {
    const auto moved = [half](const Twist& twist) {
      return Pose2{half * twist.linear.x(), half * twist.linear.y(), half * twist.angular};
    };
    const bool is_clockwise = (duration_ < 0.0) != (scan.angle_increment < 0.0);
    undone_ = {{moved(before), moved(after)}, is_clockwise ? -1.0 : 1.0};
    swept_ = swept;
  }
  return cca::undistort(swept, before, after);
}

Scan MotionCompensation::undistortBy(const SweepHalves& motion) const {
  const double half = 0.5 * std::abs(swept_.sweep_duration);
  const auto twist = [half](const Pose2& way) {
    return Twist{way.position() / half, way.theta / half};
  };
  return cca::undistort(swept_, twist(motion.before), twist(motion.after));
}

void MotionCompensation::amend(const Pose2& T_odom_sensor) {
  if (!taken_.empty()) taken_.back().middle.T_odom_sensor = T_odom_sensor;
}

void MotionCompensation::repeat() {
  taken_.clear();
  is_repeating_ = true;
}

/// s, between the scans; nothing where they come as the robot moves, or too few have come.
std::optional<double> MotionCompensation::period() const {
  if (periods_.size() < kLeastPeriods) return std::nullopt;
  std::vector<double> sorted(periods_.begin(), periods_.end());
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const auto regular = std::count_if(sorted.begin(), sorted.end(), [median](double period) {
    return std::abs(period - median) < kIrregular * median;
  });
  if (2 * static_cast<std::size_t>(regular) < sorted.size()) return std::nullopt;
  return median;
}

/// s, how long the sweep would be if it is one; 0 where nothing tells.
double MotionCompensation::candidate(const Scan& scan) const {
  const double told = std::abs(scan.sweep_duration);
  const auto period = this->period();
  const bool is_plausible = told > 0.0 &&
                            told <= (period ? (1.0 + kIrregular) * *period : kSlowestLaser) &&
                            (!period || told >= kShortest * *period);
  if (is_plausible) return told;
  const double field_of_view =
      static_cast<double>(scan.size() - 1) * std::abs(scan.angle_increment);
  return period ? *period * std::min(1.0, field_of_view / (2.0 * M_PI)) : 0.0;
}

double MotionCompensation::signedDuration(const Scan& scan, double candidate) const {
  if (const auto sense = identification_.sense()) {
    return *sense == SweepSense::kInstant   ? 0.0
           : *sense == SweepSense::kForward ? candidate
                                            : -candidate;
  }
  return candidate == std::abs(scan.sweep_duration) ? scan.sweep_duration : 0.0;
}

/// Asks about the scan before, whose motion is known now from both sides.
void MotionCompensation::identify(const Taken& next) {
  if (taken_.size() < 2) return;
  const Taken &before = taken_[taken_.size() - 2], &asked = taken_.back();
  if (!(asked.candidate > 0.0)) return;
  if (std::abs(asked.candidate - identified_for_) > kIrregular * asked.candidate) {
    identification_ = SweepIdentification();
    lasers_ += identified_for_ > 0.0;
    identified_for_ = asked.candidate;
  }
  const double believed = signedDuration(asked.scan, asked.candidate);
  identification_.add(asked.scan, identified_for_, twistBetween(before.middle, next.middle),
                      asked.middle.T_odom_sensor);
  version_ += signedDuration(asked.scan, asked.candidate) != believed;
}

}  // namespace cca
