// SPDX-License-Identifier: BSD-3-Clause
#include "sound_log.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "held_odometry.hpp"
#include "io/files/text.hpp"
#include "laser_place.hpp"
#include "sensing/scan_faults.hpp"

namespace cca {
namespace {

/// m/s; no robot with a 2-D laser drives so fast. In millimetres it does at a crawl, at 3 cm/s.
constexpr double kFastestDriven = 30.0;
/// m; farther than any place on the Earth, in any frame that maps use. Squares of it are numbers.
constexpr double kFarthestPose = 1e8;

bool isOnEarth(const std::optional<Pose2>& pose) {
  return !pose || pose->position().cwiseAbs().maxCoeff() <= kFarthestPose;
}

/// Of the laser at a record's place on the robot. @param record  that tells where the robot was.
std::optional<SensorReading> readingOf(const LogRecord& record, const Pose2& T_robot_sensor) {
  const auto& pose = record.odometry ? record.odometry : record.corrected;
  if (!pose || !record.has_time) return std::nullopt;
  return SensorReading{*pose * T_robot_sensor, record.time};
}

class SoundLog : public LogReader {
 public:
  explicit SoundLog(std::unique_ptr<LogReader> log) : log_(std::move(log)), ahead_(nextSound()) {}

  bool hasEnded() const { return !ahead_; }

  std::optional<LogRecord> next() override {
    if (!ahead_) return std::nullopt;
    LogRecord record = std::move(*ahead_);
    ahead_ = nextSound();
    if (ahead_) judgeSpeed(record, *ahead_);
    if (record.motion.middle) return record;
    record.motion.middle = readingOf(record, record.T_robot_sensor);
    if (ahead_) record.motion.after = readingOf(*ahead_, record.T_robot_sensor);
    return record;
  }

  std::string warnings() const override {
    std::string text = log_->warnings();
    const auto tell = [&text](std::size_t count, const std::string& what) {
      if (count > 0) appendWarning(std::to_string(count) + " scan(s) left out: " + what, text);
    };
    tell(repeated_,
         "equal to the one before, though the wheels went on (the driver hangs); the first is "
         "number " +
             std::to_string(first_repeated_));
    tell(long_, formatted("ranges look like millimetres (median %g), and must be metres", median_));
    tell(far_,
         "their poses are beyond 100 000 km; the first is number " + std::to_string(first_far_));
    if (2 * fast_ > steps_) {
      appendWarning(
          formatted("poses look like millimetres (the robot would drive at %.0f m/s), and "
                    "must be metres",
                    speed_),
          text);
    }
    return text;
  }
  double progress() const override { return log_->progress(); }

 private:
  void judgeSpeed(const LogRecord& before, const LogRecord& after) {
    const auto from = readingOf(before, {}), to = readingOf(after, {});
    if (!from || !to || !(to->time > from->time)) return;
    const double way = (to->T_odom_sensor.position() - from->T_odom_sensor.position()).norm();
    const double speed = way / (to->time - from->time);
    ++steps_;
    if (speed > kFastestDriven && fast_++ == 0) speed_ = speed;
  }

  /// The next scan that is evidence of anything.
  std::optional<LogRecord> nextSound() {
    while (auto record = log_->next()) {
      const auto fault =
          faults_[laserPlace(record->T_robot_sensor)].check(record->scan, record->odometry);
      ++read_;
      if (!isOnEarth(record->truth)) record->truth.reset();
      if (!isOnEarth(record->corrected) || !isOnEarth(record->odometry)) {
        if (far_++ == 0) first_far_ = read_ - 1;
        continue;
      }
      if (fault == ScanFault::kNone) return record;
      if (fault == ScanFault::kRepeated && repeated_++ == 0) first_repeated_ = read_ - 1;
      if (fault == ScanFault::kMillimetres && long_++ == 0) median_ = medianReturn(record->scan);
    }
    return std::nullopt;
  }

  std::unique_ptr<LogReader> log_;
  std::map<LaserPlace, ScanFaults> faults_;
  std::size_t read_ = 0, repeated_ = 0, first_repeated_ = 0, long_ = 0, far_ = 0, first_far_ = 0;
  std::size_t steps_ = 0, fast_ = 0;  ///< from scan to scan; those that no robot drives
  double median_ = 0.0;               ///< m, of the first scan that looks like millimetres
  double speed_ = 0.0;                ///< m/s, of the first step that no robot drives
  std::optional<LogRecord> ahead_;
};

}  // namespace

std::unique_ptr<LogReader> soundScansOf(std::unique_ptr<LogReader> log, const std::string& path) {
  auto sound = std::make_unique<SoundLog>(withoutHeldOdometry(std::move(log)));
  if (path.empty() || !sound->hasEnded()) return sound;
  const std::string why = sound->warnings();
  throw std::runtime_error(path + ": holds no scan of a 2-D laser" +
                           (why.empty() ? "" : " (" + why + ")"));
}

}  // namespace cca
