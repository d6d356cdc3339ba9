// SPDX-License-Identifier: BSD-3-Clause
#include "undistorted_log.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "laser_place.hpp"
#include "sensing/motion_compensation.hpp"

namespace cca {
namespace {

/// Scans of the first pass: at ten a second, that a robot turns in, and that it turns often in.
constexpr std::size_t kToBegin = 100, kToSettle = 5000;

/// One for each laser.
class Lasers {
 public:
  explicit Lasers(const std::optional<double>& sweep) : sweep_(sweep) {}

  void undistort(LogRecord& record) {
    MotionCompensation& laser = of(record.T_robot_sensor);
    record.scan = laser.undistort(record.scan, record.motion);
    record.undone = laser.undone();
  }

  /// Whether more scans may tell more.
  bool isLearning() const {
    return std::any_of(lasers_.begin(), lasers_.end(),
                       [](const auto& laser) { return laser.second.isLearning(); });
  }

  void repeat() {
    for (auto& [place, laser] : lasers_) laser.repeat();
  }

 private:
  MotionCompensation& of(const Pose2& T_robot_sensor) {
    const auto fresh = sweep_ ? MotionCompensation(*sweep_) : MotionCompensation();
    return lasers_.emplace(laserPlace(T_robot_sensor), fresh).first->second;
  }

  std::optional<double> sweep_;
  std::map<LaserPlace, MotionCompensation> lasers_;
};

/// What a first pass over the log tells.
Lasers survey(LogReader& log) {
  Lasers lasers{std::nullopt};
  for (std::size_t scans = 0; scans < kToSettle; ++scans) {
    if (scans > kToBegin && !lasers.isLearning()) break;
    auto record = log.next();
    if (!record) break;
    lasers.undistort(*record);
  }
  lasers.repeat();
  return lasers;
}

class UndistortedLog : public LogReader {
 public:
  UndistortedLog(std::unique_ptr<LogReader> log, Lasers lasers)
      : log_(std::move(log)), lasers_(std::move(lasers)) {}

  std::optional<LogRecord> next() override {
    auto record = log_->next();
    if (record) lasers_.undistort(*record);
    return record;
  }

  std::string warnings() const override { return log_->warnings(); }
  double progress() const override { return log_->progress(); }

 private:
  std::unique_ptr<LogReader> log_;
  Lasers lasers_;
};

}  // namespace

std::unique_ptr<LogReader> undistortedLog(const std::function<std::unique_ptr<LogReader>()>& open,
                                          const std::optional<double>& sweep) {
  auto lasers = sweep ? Lasers(sweep) : survey(*open());
  return std::make_unique<UndistortedLog>(open(), std::move(lasers));
}

}  // namespace cca
