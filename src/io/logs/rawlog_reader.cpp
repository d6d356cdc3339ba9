// SPDX-License-Identifier: BSD-3-Clause
#include "rawlog_reader.hpp"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/system/datetime.h>

#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>

#include "cca_mrpt/sensing/missing_returns.hpp"
#include "io/files/text.hpp"
#include "io/mrpt/mrpt_objects.hpp"
#include "io/mrpt/mrpt_scan.hpp"

namespace cca {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;

constexpr std::size_t kLongestWait = 2000;  // scans that wait for the odometry that follows them

Pose2 toPose2(const mrpt::poses::CPose2D& pose) {
  return {pose.x(), pose.y(), wrapAngle(pose.phi())};
}

/// @return  s since 1970; nothing for INVALID_TIMESTAMP.
std::optional<double> seconds(const mrpt::system::TTimeStamp& stamp) {
  if (stamp == INVALID_TIMESTAMP) return std::nullopt;
  return mrpt::Clock::toDouble(stamp);
}

/// How the robot moved, as its wheels say; as the log's best guess where they say nothing.
Pose2 movement(CActionCollection& actions) {
  using mrpt::obs::CActionRobotMovement2D;
  if (auto wheels = actions.getMovementEstimationByType(CActionRobotMovement2D::emOdometry)) {
    return toPose2(wheels->rawOdometryIncrementReading);
  }
  if (auto best = actions.getBestMovementEstimation(); best && best->poseChange) {
    return toPose2(best->poseChange->getMeanVal());
  }
  if (auto spatial = actions.getActionByClass<mrpt::obs::CActionRobotMovement3D>()) {
    return toPose2(mrpt::poses::CPose2D(spatial->poseChange.mean));
  }
  return {};
}

std::optional<double> actionTime(const CActionCollection& actions) {
  return actions.size() > 0 ? seconds((*actions.begin())->timestamp) : std::nullopt;
}

/// Takes the scans of a file of MRPT's.
class MrptScans {
 public:
  /// A scan at its laser's place on the robot, its missing returns judged; nothing for one of a
  /// tilted laser. @param action_time  s, of a scan without time stamp.
  std::optional<LogRecord> recordOf(const CObservation2DRangeScan& observation,
                                    const std::optional<double>& action_time = {}) {
    auto mounted = fromMrpt(observation);
    if (!mounted) {
      ++left_out_;
      return std::nullopt;
    }
    missing_returns_[observation.sensorLabel].judge(mounted->scan);
    LogRecord record;
    record.scan = std::move(mounted->scan);
    record.T_robot_sensor = record.scan.T_map_sensor = mounted->T_robot_sensor;
    auto time = seconds(observation.timestamp);
    if (!time) time = action_time;
    record.has_time = time.has_value();
    record.time = time.value_or(0.0);
    return record;
  }

  std::size_t leftOut() const { return left_out_; }

 private:
  std::map<std::string, MissingReturns> missing_returns_;  ///< of each laser, by its label
  std::size_t left_out_ = 0;
};

class RawlogReader : public LogReader {
 public:
  explicit RawlogReader(const std::string& path) : objects_(path) {}

  std::optional<LogRecord> next() override {
    while (ready_.empty()) {
      const auto object = objects_.next();
      if (!object) {
        if (waiting_.empty()) return std::nullopt;
        release(HUGE_VAL);
      } else {
        take(*object);
      }
    }
    LogRecord record = std::move(ready_.front());
    ready_.pop_front();
    return record;
  }

  std::string warnings() const override {
    std::string text = objects_.fault();
    if (scans_.leftOut() > 0) {
      appendWarning(
          std::to_string(scans_.leftOut()) + " scan(s) of a tilted or impossible laser left out",
          text);
    }
    return text;
  }

  double progress() const override { return objects_.progress(); }

 private:
  void take(mrpt::serialization::CSerializable& object) {
    if (auto* actions = dynamic_cast<CActionCollection*>(&object)) {
      const Pose2 moved = movement(*actions);
      if (isFinite(moved)) T_odom_robot_ = T_odom_robot_ * moved;
      action_time_ = actionTime(*actions);
    } else if (const auto* frame = dynamic_cast<const CSensoryFrame*>(&object)) {
      for (const auto& observation : *frame) takeOfFrame(observation.get());
      action_time_.reset();
    } else if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&object)) {
      if (auto record = scans_.recordOf(*scan, action_time_))
        waiting_.push_back(std::move(*record));
      if (waiting_.size() > kLongestWait) release(HUGE_VAL);
    } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&object)) {
      takeOdometry(*odometry);
    }
  }

  void takeOfFrame(const mrpt::obs::CObservation* observation) {
    const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(observation);
    if (!scan) return;
    auto record = scans_.recordOf(*scan, action_time_);
    if (!record) return;
    setOdometry(*record, T_odom_robot_);
    ready_.push_back(std::move(*record));
  }

  static void setOdometry(LogRecord& record, const Pose2& T_odom_robot) {
    record.odometry = T_odom_robot;
    record.scan.T_map_sensor = T_odom_robot * record.T_robot_sensor;
  }

  void takeOdometry(const CObservationOdometry& observation) {
    const Pose2 pose = toPose2(observation.odometry);
    const auto time = seconds(observation.timestamp);
    if (!isFinite(pose) || !time) return;
    later_ = Stamped{*time, pose};
    release(*time);
    earlier_ = later_;
  }

  /// Gives out the scans up to a time, each at the odometry interpolated to its own.
  void release(double until) {
    while (!waiting_.empty() && (!waiting_.front().has_time || waiting_.front().time <= until)) {
      if (later_) setOdometry(waiting_.front(), odometryAt(waiting_.front()));
      ready_.push_back(std::move(waiting_.front()));
      waiting_.pop_front();
    }
  }

  Pose2 odometryAt(const LogRecord& record) const {
    if (!earlier_ || !record.has_time || !(later_->time > earlier_->time)) return later_->pose;
    const double t = (record.time - earlier_->time) / (later_->time - earlier_->time);
    return poseBetween(earlier_->pose, later_->pose, std::clamp(t, 0.0, 1.0));
  }

  struct Stamped {
    double time;
    Pose2 pose;
  };

  MrptObjects objects_;
  Pose2 T_odom_robot_;  ///< of action-observation pairs
  std::optional<double> action_time_;
  std::optional<Stamped> earlier_, later_;  ///< of plain observations
  std::deque<LogRecord> waiting_, ready_;
  MrptScans scans_;
};

class SimpleMapReader : public LogReader {
 public:
  explicit SimpleMapReader(const std::string& path) {
    MrptObjects objects(path);
    map_ = std::dynamic_pointer_cast<mrpt::maps::CSimpleMap>(objects.next());
    if (!map_) {
      throw std::runtime_error(path + ": cannot be read as a .simplemap: " +
                               (objects.fault().empty() ? "it ends early" : objects.fault()));
    }
  }

  std::optional<LogRecord> next() override {
    while (ready_.empty() && at_ < map_->size()) takeFrame(at_++);
    if (ready_.empty()) return std::nullopt;
    LogRecord record = std::move(ready_.front());
    ready_.pop_front();
    return record;
  }

  std::string warnings() const override {
    const std::size_t left_out = scans_.leftOut();
    return left_out > 0 ? std::to_string(left_out) + " scan(s) of a tilted laser left out" : "";
  }

  double progress() const override {
    return map_->empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(map_->size());
  }

 private:
  void takeFrame(std::size_t index) {
    const auto pair = map_->getAsPair(index);
    if (!pair.pose || !pair.sf) return;
    const Pose2 T_map_robot = toPose2(mrpt::poses::CPose2D(pair.pose->getMeanVal()));
    if (!isFinite(T_map_robot)) return;
    for (const auto& observation : *pair.sf) {
      const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(observation.get());
      if (!scan) continue;
      auto record = scans_.recordOf(*scan);
      if (!record) continue;
      record->corrected = T_map_robot;
      record->scan.T_map_sensor = T_map_robot * record->T_robot_sensor;
      ready_.push_back(std::move(*record));
    }
  }

  mrpt::maps::CSimpleMap::Ptr map_;
  MrptScans scans_;
  std::size_t at_ = 0;
  std::deque<LogRecord> ready_;
};

}  // namespace

std::unique_ptr<LogReader> openRawlog(const std::string& path) {
  return std::make_unique<RawlogReader>(path);
}

std::unique_ptr<LogReader> openSimpleMap(const std::string& path) {
  return std::make_unique<SimpleMapReader>(path);
}

}  // namespace cca
