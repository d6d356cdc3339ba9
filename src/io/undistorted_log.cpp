// SPDX-License-Identifier: BSD-3-Clause
#include "undistorted_log.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "cca_mrpt/sensing/motion_compensation.hpp"
#include "cca_mrpt/sensing/scan_faults.hpp"

namespace cca {
namespace {

/// Scans of the first pass: at ten a second, that a robot turns in, and that it turns often in.
constexpr std::size_t kToBegin = 100, kToSettle = 5000;

std::optional<OdometryReading> readingOf(const LogRecord& record) {
  const auto& pose = record.odometry ? record.odometry : record.corrected;
  if (!pose || !record.has_time) return std::nullopt;
  return OdometryReading{*pose, record.time};
}

/// "12 scan(s) left out: ..."; empty where there are none.
std::string toldOf(std::size_t count, const std::string& what) {
  return count > 0 ? std::to_string(count) + " scan(s) left out: " + what : "";
}

/// One for each laser: logs tell them apart by where they are on the robot.
class Lasers {
 public:
  explicit Lasers(const std::optional<double>& sweep) : sweep_(sweep) {}

  ScanFaults& faultsOf(const LogRecord& record) { return faults_[keyOf(record)]; }

  MotionCompensation& of(const LogRecord& record) {
    const Key key = keyOf(record);
    const auto laser = lasers_.find(key);
    if (laser != lasers_.end()) return laser->second;
    const auto fresh = sweep_ ? MotionCompensation(*sweep_) : MotionCompensation();
    return lasers_.emplace(key, fresh).first->second;
  }

  /// Whether more scans may tell more.
  bool isLearning() const {
    return std::any_of(lasers_.begin(), lasers_.end(),
                       [](const auto& laser) { return laser.second.isLearning(); });
  }

  void beginAnew() {
    for (auto& [place, laser] : lasers_) laser.beginAnew();
  }

 private:
  using Key = std::tuple<double, double, double>;
  static Key keyOf(const LogRecord& record) {
    const Pose2& T = record.T_robot_sensor;
    return {T.x, T.y, T.theta};
  }

  std::optional<double> sweep_;
  std::map<Key, MotionCompensation> lasers_;
  std::map<Key, ScanFaults> faults_;
};

/// What a first pass over the log tells. A log that cannot be opened twice is gone through once.
Lasers survey(const std::function<std::unique_ptr<LogReader>()>& open) {
  Lasers lasers{std::nullopt};
  const auto log = open();
  for (std::size_t scans = 0; scans < kToSettle; ++scans) {
    if (scans > kToBegin && !lasers.isLearning()) break;
    const auto record = log->next();
    if (!record) break;
    lasers.of(*record).undistort(record->scan, record->T_robot_sensor, readingOf(*record));
  }
  lasers.beginAnew();
  return lasers;
}

class UndistortedLog : public LogReader {
 public:
  UndistortedLog(std::unique_ptr<LogReader> log, Lasers lasers)
      : log_(std::move(log)), lasers_(std::move(lasers)), ahead_(nextSound()) {}

  std::optional<LogRecord> next() override {
    if (!ahead_) return std::nullopt;
    LogRecord record = std::move(*ahead_);
    ahead_ = nextSound();
    const auto next = ahead_ ? readingOf(*ahead_) : std::nullopt;
    record.scan = lasers_.of(record).undistort(record.scan, record.T_robot_sensor,
                                               readingOf(record), {std::nullopt, next});
    return record;
  }

  std::string warnings() const override {
    std::string text = log_->warnings();
    char long_ranges[120];
    std::snprintf(long_ranges, sizeof long_ranges,
                  "ranges look like millimetres (median %g), and must be metres", median_);
    for (const std::string& told :
         {toldOf(repeated_,
                 "equal to the one before, though the wheels went on (the driver hangs); the "
                 "first is number " +
                     std::to_string(first_repeated_)),
          toldOf(long_, long_ranges)}) {
      text += (text.empty() || told.empty() ? "" : "; ") + told;
    }
    return text;
  }
  double progress() const override { return log_->progress(); }

 private:
  /// The next scan that is evidence of anything.
  std::optional<LogRecord> nextSound() {
    while (auto record = log_->next()) {
      const auto fault = lasers_.faultsOf(*record).check(record->scan, record->odometry);
      ++read_;
      if (fault == ScanFault::kNone) return record;
      if (fault == ScanFault::kRepeated && repeated_++ == 0) first_repeated_ = read_ - 1;
      if (fault == ScanFault::kMillimetres && long_++ == 0) median_ = medianReturn(record->scan);
    }
    return std::nullopt;
  }

  std::unique_ptr<LogReader> log_;
  Lasers lasers_;
  std::size_t read_ = 0, repeated_ = 0, first_repeated_ = 0, long_ = 0;
  double median_ = 0.0;  ///< m, of the first scan that looks like millimetres
  std::optional<LogRecord> ahead_;
};

}  // namespace

std::unique_ptr<LogReader> undistorted(std::unique_ptr<LogReader> log,
                                       const std::function<std::unique_ptr<LogReader>()>& open,
                                       const std::optional<double>& sweep) {
  return std::make_unique<UndistortedLog>(std::move(log), sweep ? Lasers(sweep) : survey(open));
}

}  // namespace cca
