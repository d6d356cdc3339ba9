// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "io/files/text.hpp"
#include "text_formats.hpp"

namespace cca {
namespace {

// The robot of the files: ticks of its wheels, and where its laser stands.
constexpr double kTicksPerTurn = 2000.0, kWheelRadius = 0.077, kTrack = 0.33;  // m, m
constexpr double kLaserAhead = 0.145;                                          // m

// Hokuyo's URG-04LX: steps 44 to 725 of 1024 in a turn, 384 straight ahead.
constexpr std::size_t kUrgRays = 682;
constexpr double kUrgStep = 2.0 * M_PI / 1024.0;  // rad
constexpr double kUrgFirst = (44 - 384) * kUrgStep;
constexpr double kUrgShortest = 0.02;  // m; below, a reading is a code of an error
/// Rays at either end that see the robot itself.
constexpr std::size_t kBlockedRays = 70;

/// Numbers before the ranges: 25, of which some who write such files leave out the last one.
constexpr std::size_t kLeastBefore = 24, kMostBefore = 25;
constexpr double kMetresPerTick = 2.0 * M_PI * kWheelRadius / kTicksPerTurn;

/// The blank-separated numbers of a line; empty where one of its words is none.
std::vector<double> numbersOf(std::string_view line) {
  std::vector<double> numbers;
  for (line = withoutBlanks(line); !line.empty(); line = withoutBlanks(line)) {
    const std::size_t end = std::min(line.find(' '), line.size());
    const auto number = numberOf(withoutBlanks(line.substr(0, end)));
    if (!number) return {};
    numbers.push_back(*number);
    line.remove_prefix(end);
  }
  return numbers;
}

Scan urgScan(const double* millimetres) {
  Scan scan;
  scan.angle_min = kUrgFirst;
  scan.angle_increment = kUrgStep;
  for (std::size_t k = 0; k < kUrgRays; ++k) {
    const bool is_blocked = k < kBlockedRays || k >= kUrgRays - kBlockedRays;
    const double range = 1e-3 * millimetres[k];
    scan.ranges.push_back(is_blocked             ? NAN
                          : range == 0.0         ? std::numeric_limits<double>::infinity()
                          : range < kUrgShortest ? NAN
                                                 : range);
  }
  return scan;
}

class CoreSlamLines : public LineFormat {
 public:
  std::optional<LogRecord> parse(std::string_view line) override {
    if (withoutBlanks(line).empty()) return std::nullopt;
    const std::vector<double> numbers = numbersOf(line);
    if (numbers.empty())
      throw MalformedLine("blank-separated numbers are needed, and nothing else");
    if (numbers.size() < kLeastBefore + kUrgRays || numbers.size() > kMostBefore + kUrgRays) {
      throw MalformedLine(
          "24 or 25 numbers, and then the 682 ranges of a URG-04LX, are needed; there are " +
          std::to_string(numbers.size()) + " numbers");
    }
    for (const std::size_t k : {0, 2, 3}) {
      if (!std::isfinite(numbers[k]))
        throw MalformedLine("time and wheel ticks: finite numbers are needed");
    }
    LogRecord record;
    record.scan = urgScan(numbers.data() + numbers.size() - kUrgRays);
    record.time = 1e-6 * numbers[0];
    drive(numbers[2], numbers[3]);
    record.odometry = T_odom_robot_;
    record.T_robot_sensor = {kLaserAhead, 0.0, 0.0};
    record.scan.T_map_sensor = T_odom_robot_ * record.T_robot_sensor;
    return record;
  }

 private:
  /// Along an arc, from the ticks of the last line.
  void drive(double left, double right) {
    const double way = 0.5 * kMetresPerTick * (left - left_ + right - right_);
    const double turn = kMetresPerTick * (right - right_ - left + left_) / kTrack;
    left_ = left;
    right_ = right;
    if (!std::exchange(has_begun_, true)) return;
    const double chord = std::abs(turn) > 1e-9 ? way * std::sin(0.5 * turn) / (0.5 * turn) : way;
    T_odom_robot_ =
        T_odom_robot_ * Pose2{chord * std::cos(0.5 * turn), chord * std::sin(0.5 * turn), turn};
  }

  double left_ = 0.0, right_ = 0.0;  ///< ticks
  bool has_begun_ = false;
  Pose2 T_odom_robot_;
};

}  // namespace

std::unique_ptr<LineFormat> coreSlamLines() { return std::make_unique<CoreSlamLines>(); }

bool looksLikeCoreSlam(const std::string& head) {
  const std::size_t begin = head.find_first_not_of("\r\n");
  if (begin == std::string::npos) return false;
  const std::size_t end = head.find('\n', begin);
  return numbersOf(std::string_view(head).substr(begin, end - begin)).size() > kMostBefore;
}

}  // namespace cca
