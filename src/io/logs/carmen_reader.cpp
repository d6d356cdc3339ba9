// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>
#include <utility>

#include "carmen_line.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "io/files/gzip_lines.hpp"
#include "io/files/text.hpp"
#include "text_formats.hpp"

namespace cca {
namespace {

constexpr double kShortestRange = 0.05;   // m; below it a SICK reports errors
constexpr double kLongestMounting = 2.0;  // m; a laser further from the robot is a corrected pose

/// Lines of the same lasers: a log may carry a scan as more than one of them.
enum class CarmenFamily {
  kSick,    ///< FLASER and RLASER
  kRobot,   ///< ROBOTLASER1, ROBOTLASER2
  kRaw,     ///< RAWLASER1, whose poses are those of the ODOM lines about it
  kRawRear  ///< RAWLASER2, likewise
};

bool isRaw(CarmenFamily family) {
  return family == CarmenFamily::kRaw || family == CarmenFamily::kRawRear;
}

CarmenFamily familyOf(CarmenMessage message) {
  if (message == CarmenMessage::kRawLaser) return CarmenFamily::kRaw;
  if (message == CarmenMessage::kRawRearLaser) return CarmenFamily::kRawRear;
  return message == CarmenMessage::kRobotLaser ? CarmenFamily::kRobot : CarmenFamily::kSick;
}

/// What a first pass over the log tells about all of it.
struct Survey {
  CarmenFamily family = CarmenFamily::kSick;  ///< that is read
  std::size_t scans = 0, damaged_lines = 0;
  bool damaged_file = false;
  std::map<std::string, std::size_t>
      left_out;                 ///< lines of lasers whose place nobody tells, by name
  double no_return_from = 0.0;  ///< m
  bool rewritten = false;       ///< poses are a SLAM program's
  bool has_odometry = false;    ///< a chain of raw odometry leads through the log
  bool mounting_holds = false;  ///< laser and robot pose differ by the same in every scan
};

/// Surveys one of the families of laser lines.
class Surveyor {
 public:
  void add(const CarmenScan& scan) {
    ++scans_;
    Scan read;
    read.angle_increment = scan.angle_increment;
    const double own = scan.max_range > 0.0 ? kOfReach * scan.max_range : HUGE_VAL;
    for (const double range : scan.ranges) read.ranges.push_back(range < own ? range : HUGE_VAL);
    saturation_.add(read);
    if (scan.message != CarmenMessage::kRearLaser) addMounting(scan);
    scans_with_odometry_ += odometry_lines_ > 0;
    odometry_lines_ = 0;
    last_laser_ = scan.laser;
  }

  void add(const Pose2& odometry) {
    const bool copy = last_laser_ && areNear(*last_laser_, odometry, 1e-9);
    odometry_lines_ += !copy;
    last_laser_.reset();
  }

  void addEffectiveParticles() { ++effective_particles_; }

  Survey survey() const {
    Survey survey;
    survey.scans = scans_;
    survey.no_return_from = saturation_.threshold();
    survey.rewritten = 2 * effective_particles_ > scans_;
    survey.has_odometry = !survey.rewritten || 10 * scans_with_odometry_ >= 9 * scans_;
    survey.mounting_holds = mounting_holds_ && !survey.rewritten;
    return survey;
  }

 private:
  void addMounting(const CarmenScan& scan) {
    const Pose2 mounting = scan.robot.inverse() * scan.laser;
    if (!mounting_) mounting_ = mounting;
    mounting_holds_ = mounting_holds_ && mounting.position().norm() < kLongestMounting &&
                      areNear(*mounting_, mounting, 1e-2);
  }

  Saturation saturation_;
  std::size_t scans_ = 0, scans_with_odometry_ = 0, odometry_lines_ = 0, effective_particles_ = 0;
  std::optional<Pose2> last_laser_, mounting_;
  bool mounting_holds_ = true;
};

Survey surveyLog(const std::string& path) {
  GzipLines lines(path);
  std::map<CarmenFamily, Surveyor> families{{CarmenFamily::kSick, {}},
                                            {CarmenFamily::kRobot, {}},
                                            {CarmenFamily::kRaw, {}},
                                            {CarmenFamily::kRawRear, {}}};
  std::map<std::string, std::size_t> left_out;
  std::size_t damaged = 0;
  bool has_odometry_lines = false;
  while (const auto line = lines.next()) {
    if (const auto odometry = parseCarmenOdometry(*line)) {
      for (auto& [family, surveyor] : families) surveyor.add(odometry->T_odom_robot);
      has_odometry_lines = true;
    } else if (const auto scan = parseCarmenScan(*line)) {
      families[familyOf(scan->message)].add(*scan);
    } else if (line->substr(0, 5) == "NEFF ") {  // a line that only GMapping writes, one a scan
      for (auto& [family, surveyor] : families) surveyor.addEffectiveParticles();
    } else if (const auto name = unplacedLaser(*line); !name.empty()) {
      ++left_out[std::string(name)];
    } else {
      damaged += isCarmenScan(*line);
    }
  }
  const auto scansOf = [&](CarmenFamily family) { return families[family].survey().scans; };
  CarmenFamily family = CarmenFamily::kSick;
  if (scansOf(CarmenFamily::kRobot) > scansOf(family)) family = CarmenFamily::kRobot;
  if (scansOf(family) == 0) family = CarmenFamily::kRaw;  // others carry the same with their poses
  if (scansOf(family) == 0) family = CarmenFamily::kRawRear;
  const std::size_t rear = scansOf(CarmenFamily::kRawRear);
  if (family == CarmenFamily::kRaw && rear > 0) left_out["RAWLASER2"] = rear;
  Survey survey = families[family].survey();
  survey.family = family;
  survey.left_out = std::move(left_out);
  if (isRaw(family)) {
    survey.has_odometry = has_odometry_lines;
    survey.rewritten = survey.mounting_holds = false;
  }
  survey.damaged_lines = damaged;
  survey.damaged_file = lines.damaged();
  return survey;
}

/// Undoes what GMapping did to the odometry: increments of the ODOM lines, one after another,
/// without the jumps to each corrected pose.
class OdometryChain {
 public:
  void add(const Pose2& logged, bool starts_anew) {
    if (last_ && !starts_anew) T_odom_robot_ = T_odom_robot_ * (last_->inverse() * logged);
    if (!last_) T_odom_robot_ = logged;
    last_ = logged;
  }
  const Pose2& pose() const { return T_odom_robot_; }

 private:
  Pose2 T_odom_robot_;
  std::optional<Pose2> last_;
};

class CarmenReader : public LogReader {
 public:
  explicit CarmenReader(const std::string& path)
      : path_(path), survey_(surveyLog(path)), lines_(path) {
    if (survey_.scans == 0) {
      throw std::runtime_error(
          path + ": holds no whole laser scan (FLASER, RLASER, ROBOTLASER1, RAWLASER1, RAWLASER2)" +
          (warnings().empty() ? "" : "; " + warnings()));
    }
  }

  std::optional<LogRecord> next() override {
    if (isRaw(survey_.family)) return nextRaw();
    while (const auto line = lines_.next()) {
      if (const auto odometry = parseCarmenOdometry(*line)) {
        const Pose2& logged = odometry->T_odom_robot;
        chain_.add(logged, last_laser_ && areNear(*last_laser_, logged, 1e-9));
        last_laser_.reset();
      } else if (const auto scan = parseCarmenScan(*line)) {
        if (familyOf(scan->message) == survey_.family) return record(*scan);
      }
    }
    return std::nullopt;
  }

  std::string warnings() const override {
    std::string text;
    if (survey_.damaged_file) text = "the compressed file is damaged or ends early";
    if (survey_.damaged_lines > 0) {
      appendWarning(std::to_string(survey_.damaged_lines) + " damaged laser line(s) left out",
                    text);
    }
    for (const auto& [name, lines] : survey_.left_out) {
      appendWarning(
          std::to_string(lines) + " " + name +
              " line(s) left out: where on the robot that laser is, the log does not tell",
          text);
    }
    return text;
  }

  double progress() const override { return lines_.progress(); }

 private:
  /// The next line of a raw laser, which waits for the ODOM line after it.
  std::optional<LogRecord> nextRaw() {
    while (waiting_.empty() || !(may_leave_ || !survey_.has_odometry)) {
      const auto line = lines_.next();
      if (!line) {
        if (waiting_.empty()) return std::nullopt;
        earlier_ = later_;
        may_leave_ = true;
      } else if (const auto odometry = parseCarmenOdometry(*line)) {
        earlier_ = later_ ? later_ : odometry;
        later_ = odometry;
        may_leave_ = !waiting_.empty();
      } else if (auto scan = parseCarmenScan(*line)) {
        if (familyOf(scan->message) == survey_.family) waiting_.push_back(unplaced(*scan));
      }
    }
    LogRecord record = std::move(waiting_.front());
    waiting_.pop_front();
    if (waiting_.empty()) may_leave_ = false;
    if (survey_.family == CarmenFamily::kRawRear) record.T_robot_sensor = {0.0, 0.0, M_PI};
    if (survey_.has_odometry) record.odometry = odometryAt(record);
    record.scan.T_map_sensor = record.odometry.value_or(Pose2{}) * record.T_robot_sensor;
    return record;
  }

  /// Between the ODOM lines before and after a scan; that before, where times do not tell.
  Pose2 odometryAt(const LogRecord& record) const {
    if (!later_) return {};
    const Pose2 &from = earlier_->T_odom_robot, to = later_->T_odom_robot;
    if (!record.has_time || !earlier_->time || !later_->time || *later_->time <= *earlier_->time)
      return from;
    const double t =
        std::clamp((record.time - *earlier_->time) / (*later_->time - *earlier_->time), 0.0, 1.0);
    return poseBetween(from, to, t);
  }

  LogRecord unplaced(const CarmenScan& logged) const {
    LogRecord record;
    record.has_time = logged.time.has_value();
    record.time = logged.time.value_or(0.0);
    record.scan.angle_min = logged.angle_min;
    record.scan.angle_increment = logged.angle_increment;
    record.scan.ranges = logged.ranges;
    for (double& range : record.scan.ranges) range = judged(range, logged.max_range);
    return record;
  }

  LogRecord record(const CarmenScan& logged) {
    LogRecord record = unplaced(logged);
    record.scan.T_map_sensor = logged.laser;
    if (survey_.mounting_holds) record.T_robot_sensor = logged.robot.inverse() * logged.laser;
    // Where the robot's pose is the laser's, the wheels have written both: nothing is corrected.
    if (!survey_.mounting_holds) record.corrected = logged.laser * record.T_robot_sensor.inverse();
    if (survey_.rewritten) {
      if (survey_.has_odometry) record.odometry = chain_.pose();
      last_laser_ = logged.laser;
    } else {
      record.odometry = logged.robot;
    }
    return record;
  }

  double judged(double range, double own_maximum) const {
    const bool no_return =
        range >= survey_.no_return_from || (own_maximum > 0.0 && range >= kOfReach * own_maximum);
    if (no_return) return HUGE_VAL;
    return range >= kShortestRange ? range : 0.0;
  }

  std::string path_;
  Survey survey_;
  GzipLines lines_;
  OdometryChain chain_;
  std::optional<Pose2> last_laser_;  ///< of the scan just given, until the next ODOM line
  // Of raw lasers alone.
  std::deque<LogRecord> waiting_;                  ///< for the next ODOM line
  std::optional<CarmenOdometry> earlier_, later_;  ///< the last two ODOM lines
  bool may_leave_ = false;                         ///< whether those that wait have met it
};

}  // namespace

std::unique_ptr<LogReader> openCarmenLog(const std::string& path) {
  return std::make_unique<CarmenReader>(path);
}

}  // namespace cca
