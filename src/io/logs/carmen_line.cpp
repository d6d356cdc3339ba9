// SPDX-License-Identifier: BSD-3-Clause
#include "carmen_line.hpp"

#include <cmath>

#include "io/files/text.hpp"

namespace cca {
namespace {

constexpr double kMostBeams = 1e6;

/// The words of a line, one by one. Once a number is missing or malformed, ok() stays false.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view word() {
    const std::size_t begin = rest_.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return rest_ = {};
    const std::size_t end = std::min(rest_.find_first_of(" \t\r", begin), rest_.size());
    const std::string_view found = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return found;
  }

  double number() {
    const std::optional<double> value = numberOf(word());
    ok_ = ok_ && value;
    return value.value_or(0.0);
  }

  /// A number of values that follow, within [lowest, kMostBeams]; 0 where it is not.
  std::size_t count(double lowest) {
    const double value = number();
    ok_ = ok_ && value >= lowest && value <= kMostBeams && value == std::floor(value);
    return ok_ ? static_cast<std::size_t>(value) : 0;
  }

  Pose2 pose() {
    Pose2 pose;
    pose.x = number();
    pose.y = number();
    pose.theta = number();
    ok_ = ok_ && std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
    if (ok_) pose.theta = wrapAngle(pose.theta);
    return pose;
  }

  bool ok() const { return ok_; }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

double sickStepDegrees(std::size_t beams) {
  switch (beams) {
    case 90:
    case 91:
      return 2.0;
    case 180:
    case 181:
      return 1.0;
    case 360:
    case 361:
      return 0.5;
    case 720:
    case 721:
      return 0.25;
    default:
      return 180.0 / static_cast<double>(beams - 1);
  }
}

void readRanges(Words& words, CarmenScan& scan) {
  const std::size_t beams = words.count(2);
  scan.ranges.reserve(std::min<std::size_t>(beams, 4096));
  while (scan.ranges.size() < beams && words.ok()) scan.ranges.push_back(words.number());
}

/// `time host logger_time` at a line's end; nothing where it is missing: a scan without time is a
/// scan.
std::optional<double> readTime(Words words) {
  const double time = words.number();
  return words.ok() && std::isfinite(time) ? std::optional(time) : std::nullopt;
}

std::optional<CarmenScan> parseSickLaser(Words words, CarmenMessage message) {
  CarmenScan scan;
  scan.message = message;
  readRanges(words, scan);
  if (!words.ok()) return std::nullopt;
  scan.angle_min = -0.5 * M_PI;
  scan.angle_increment = kRadiansPerDegree * sickStepDegrees(scan.ranges.size());
  scan.robot = scan.laser = words.pose();
  if (!words.ok()) return std::nullopt;
  Words after_laser = words;
  const Pose2 robot = after_laser.pose();
  if (after_laser.ok()) scan.robot = robot;
  scan.time = readTime(after_laser.ok() ? after_laser : words);
  if (message == CarmenMessage::kRearLaser &&
      std::abs(wrapAngle(scan.laser.theta - scan.robot.theta)) < 0.5 * M_PI) {
    scan.laser.theta = wrapAngle(scan.laser.theta + M_PI);
  }
  return scan;
}

/// What ROBOTLASER and RAWLASER lines begin with: a laser's angles, ranges and remissions.
std::optional<CarmenScan> parseTellingLaser(Words& words) {
  CarmenScan scan;
  words.number();  // laser type
  scan.angle_min = words.number();
  const double field_of_view = words.number();
  scan.angle_increment = words.number();
  scan.max_range = words.number();
  words.number();  // accuracy
  words.number();  // remission mode
  readRanges(words, scan);
  for (std::size_t left = words.count(0); left > 0 && words.ok(); --left) words.number();
  if (!words.ok()) return std::nullopt;
  if (!(scan.angle_increment > 0.0)) {
    scan.angle_increment = field_of_view / static_cast<double>(scan.ranges.size() - 1);
  }
  if (!std::isfinite(scan.angle_min) || !(scan.angle_increment > 0.0) ||
      !std::isfinite(scan.angle_increment)) {
    return std::nullopt;
  }
  if (!(scan.max_range > 0.0) || !std::isfinite(scan.max_range)) scan.max_range = 0.0;
  return scan;
}

std::optional<CarmenScan> parseRawLaser(Words words, CarmenMessage message) {
  auto scan = parseTellingLaser(words);
  if (!scan) return std::nullopt;
  scan->message = message;
  scan->time = readTime(words);
  return scan;
}

std::optional<CarmenScan> parseRobotLaser(Words words) {
  auto told = parseTellingLaser(words);
  if (!told) return std::nullopt;
  CarmenScan& scan = *told;
  scan.message = CarmenMessage::kRobotLaser;
  scan.robot = scan.laser = words.pose();
  if (!words.ok()) return std::nullopt;
  Words after_laser = words;
  const Pose2 robot = after_laser.pose();
  if (after_laser.ok()) {
    scan.robot = robot;
    for (int skipped = 0; skipped < 5; ++skipped) after_laser.number();  // speeds, safety, axis
    scan.time = readTime(after_laser);
  }
  return told;
}

}  // namespace

std::optional<CarmenScan> parseCarmenScan(std::string_view line) {
  Words words(line);
  const std::string_view name = words.word();
  if (name == "FLASER") return parseSickLaser(words, CarmenMessage::kFrontLaser);
  if (name == "RLASER") return parseSickLaser(words, CarmenMessage::kRearLaser);
  if (name == "ROBOTLASER1" || name == "ROBOTLASER2") return parseRobotLaser(words);
  if (name == "RAWLASER1") return parseRawLaser(words, CarmenMessage::kRawLaser);
  if (name == "RAWLASER2") return parseRawLaser(words, CarmenMessage::kRawRearLaser);
  return std::nullopt;
}

std::optional<CarmenOdometry> parseCarmenOdometry(std::string_view line) {
  Words words(line);
  if (words.word() != "ODOM") return std::nullopt;
  CarmenOdometry odometry;
  odometry.T_odom_robot = words.pose();
  if (!words.ok()) return std::nullopt;
  for (int skipped = 0; skipped < 3; ++skipped) words.number();  // speeds, acceleration
  odometry.time = readTime(words);
  return odometry;
}

bool isCarmenScan(std::string_view line) {
  const std::string_view name = Words(line).word();
  return name == "FLASER" || name == "RLASER" || name == "ROBOTLASER1" || name == "ROBOTLASER2" ||
         name == "RAWLASER1" || name == "RAWLASER2";
}

std::string_view unplacedLaser(std::string_view line) {
  const std::string_view name = Words(line).word();
  for (const char* unplaced : {"LASER3", "LASER4", "RAWLASER3", "RAWLASER4", "RAWLASER5"}) {
    if (name == unplaced) return name;
  }
  return {};
}

bool isCarmenLine(std::string_view line) {
  const std::string_view name = Words(line).word();
  return isCarmenScan(line) || name == "ODOM" || name == "PARAM" || name == "SYNC" ||
         name == "TRUEPOS" || name == "NEFF" || name == "#" || !unplacedLaser(line).empty();
}

}  // namespace cca
