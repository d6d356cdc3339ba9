// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/sweep_identification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kAtRest = 0.05;        // rad/s; such a scan is bent by no sweep worth telling
constexpr double kTurning = 0.3;        // rad/s, by which bent scans differ from others
constexpr double kDriving = 0.25;       // m/s, likewise: 5 cm between the ends of a slow sweep
constexpr double kTurnedAway = 0.5;     // rad: a turn at constant rate shows its sweep at the seam
constexpr double kNearReference = 0.8;  // m; farther off, other surfaces come into view
constexpr double kClip = 0.3;           // m, of a difference: occlusions are no matter of the sweep
constexpr std::size_t kPoints = 180;    // of a scan that are compared
constexpr double kLeastCommon = 0.4;    // of them, that the reference has to see
constexpr double kSearch = 0.06;        // rad, of heading, from where the last scan fitted
constexpr double kCoarse = 0.01, kFine = 0.002;  // rad: half a beam of a cheap laser; a tenth
// Scans: the fewest that have a spread; enough for a sense that shows; enough to say none shows.
constexpr int kLeastTests = 4, kSettled = 30, kMostTests = 200;
// Scans that follow each other do not err independently; of a few, the spread is not known well.
constexpr double kSigmas = 4.0, kSigmasOfFew = 16.0;
constexpr double kLeastGain = 0.03;  // of the mean difference, that a sense is worth telling

struct Polar {
  double bearing, range;
};

/// The returns as the sensor would see them from the reference's place.
std::vector<Polar> seenFrom(const Pose2& T_reference_sensor, const Scan& scan) {
  std::vector<Polar> seen;
  const std::size_t step = std::max<std::size_t>(1, scan.size() / kPoints);
  const auto toReference = transformBy(T_reference_sensor);
  for (std::size_t i = 0; i < scan.size(); i += step) {
    if (!isReturn(scan.ranges[i])) continue;
    const double bearing = scan.bearing(i);
    const Eigen::Vector2d p =
        toReference(scan.ranges[i] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
    seen.push_back({std::atan2(p.y(), p.x()), p.norm()});
  }
  return seen;
}

/// m, of the surface that a scan shows at a bearing; NaN where it shows none.
double rangeAt(const Scan& scan, double bearing) {
  const double at = beamAt(bearing, scan.angle_min, scan.angle_increment);
  const auto n = static_cast<int>(scan.size());
  const bool closed = seesAllAround(scan);
  int low = static_cast<int>(std::floor(at));
  const double share = at - low;
  int high = low + 1;
  if (closed) low = (low + n) % n, high = (high + n) % n;
  if (low < 0 || high >= n) return std::numeric_limits<double>::quiet_NaN();
  const double a = scan.ranges[static_cast<std::size_t>(low)];
  const double b = scan.ranges[static_cast<std::size_t>(high)];
  if (!isReturn(a) || !isReturn(b) || std::abs(a - b) > kOneSurface * a) return share < 0.5 ? a : b;
  return a + share * (b - a);
}

/// m, the mean difference where a turn is added to the bearings; infinite where too few compare.
double difference(const std::vector<Polar>& seen, const Scan& reference, double turn) {
  double sum = 0.0;
  std::size_t common = 0;
  for (const Polar& p : seen) {
    const double range = rangeAt(reference, p.bearing + turn);
    if (!isReturn(range)) continue;
    sum += std::min(kClip, std::abs(range - p.range));
    ++common;
  }
  const bool enough = static_cast<double>(common) > kLeastCommon * static_cast<double>(seen.size());
  return enough && common > 0 ? sum / static_cast<double>(common)
                              : std::numeric_limits<double>::infinity();
}

/// The least difference, over turns about `turn`, which becomes the one that fits.
double leastDifference(const std::vector<Polar>& seen, const Scan& reference, double& turn) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [reach, step] : {std::pair(kSearch, kCoarse), std::pair(kCoarse, kFine)}) {
    const double middle = turn;
    const int steps = static_cast<int>(std::lround(reach / step));
    for (int k = -steps; k <= steps; ++k) {
      const double cost = difference(seen, reference, middle + k * step);
      if (cost >= least) continue;
      least = cost;
      turn = middle + k * step;
    }
  }
  return least;
}

Scan under(std::size_t hypothesis, const Scan& scan, double duration, const Twist& sensor) {
  // Of the sweep: as one instant, with the beams, against them; by the number of the hypothesis.
  constexpr double kSign[] = {0.0, 1.0, -1.0};
  Scan swept = scan;
  swept.sweep_duration = kSign[hypothesis] * duration;
  return undistort(swept, sensor);
}

}  // namespace

void SweepIdentification::add(const Scan& scan, double duration, const Twist& sensor,
                              const Pose2& T_odom_sensor) {
  if (isSettled() || scan.size() < 2 || !(duration > 0.0)) return;
  if (reference_ && last_) {
    reference_->turned += std::abs(wrapAngle(T_odom_sensor.theta - last_->theta));
  }
  last_ = T_odom_sensor;
  // After a full turn the odometry's heading has drifted.
  const bool is_near =
      reference_ && reference_->turned < 2.0 * M_PI &&
      (T_odom_sensor.position() - reference_->T_odom_sensor.position()).norm() < kNearReference;
  const bool is_comparable = is_near && isComparable(sensor, T_odom_sensor);
  const bool is_straighter = reference_ && std::abs(sensor.angular) < kAtRest &&
                             sensor.linear.norm() < reference_->linear.norm();
  if (!is_near || (is_straighter && !is_comparable)) {
    return begin(scan, duration, sensor, T_odom_sensor);
  }
  if (!is_comparable) return;
  const Pose2 T_reference_sensor = reference_->T_odom_sensor.inverse() * T_odom_sensor;
  Costs costs;
  for (std::size_t h = 0; h < kHypotheses; ++h) {
    const auto seen = seenFrom(T_reference_sensor, under(h, scan, duration, sensor));
    costs[h] = leastDifference(seen, reference_->scans[h], reference_->turn[h]);
    if (!std::isfinite(costs[h])) return;
  }
  count(costs);
}

bool SweepIdentification::isComparable(const Twist& sensor, const Pose2& T_odom_sensor) const {
  if ((sensor.linear - reference_->linear).norm() > kDriving) return true;
  if (std::abs(sensor.angular) < kTurning) return false;
  const double heading = wrapAngle(T_odom_sensor.theta - reference_->T_odom_sensor.theta);
  return std::abs(sensor.angular - reference_->angular) > kTurning ||
         std::abs(heading) > kTurnedAway;
}

void SweepIdentification::begin(const Scan& scan, double duration, const Twist& sensor,
                                const Pose2& T_odom_sensor) {
  reference_ = Reference();
  for (std::size_t h = 0; h < kHypotheses; ++h) {
    reference_->scans[h] = under(h, scan, duration, sensor);
  }
  reference_->angular = sensor.angular;
  reference_->linear = sensor.linear;
  reference_->T_odom_sensor = T_odom_sensor;
}

void SweepIdentification::count(const Costs& costs) {
  ++tests_;
  for (std::size_t a = 0; a < kHypotheses; ++a) {
    sum_[a] += costs[a];
    for (std::size_t b = 0; b < kHypotheses; ++b) {
      const double gain = costs[b] - costs[a];
      sum_of_differences_[a][b] += gain;
      sum_of_squares_[a][b] += gain * gain;
    }
  }
}

bool SweepIdentification::isSettled() const {
  return tests_ >= kMostTests || (tests_ >= kSettled && sense());
}

std::optional<SweepSense> SweepIdentification::sense() const {
  if (tests_ < kLeastTests) return std::nullopt;
  const double n = tests_;
  for (std::size_t a = 0; a < kHypotheses; ++a) {
    bool is_best = true;
    for (std::size_t b = 0; b < kHypotheses; ++b) {
      if (a == b) continue;
      const double mean = sum_of_differences_[a][b] / n;
      const double variance = std::max(0.0, sum_of_squares_[a][b] / n - mean * mean);
      is_best = is_best && mean > (kSigmas + kSigmasOfFew / n) * std::sqrt(variance / n) &&
                mean > kLeastGain * sum_[b] / n;
    }
    if (is_best) return static_cast<SweepSense>(a);
  }
  return std::nullopt;
}

}  // namespace cca
