// SPDX-License-Identifier: BSD-3-Clause
#include "io/logs/log_info.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/median.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kGapOfMedianSteps = 10.0;
constexpr double kSameMounting = 1e-3;  // m, rad
constexpr double kRangeBin = 0.01;      // m, of the histogram that the median range comes from
constexpr std::size_t kRangeBins = 100000;

/// Adding 0 turns a negative zero into a plain one.
double rounded(double value, double step) { return std::round(value / step) * step + 0.0; }

/// What was joined by semicolons, one by one.
Json listed(const std::string& warnings) {
  Json list = Json::array();
  for (std::size_t begin = 0; begin < warnings.size();) {
    const std::size_t end = std::min(warnings.find("; ", begin), warnings.size());
    list.push_back(warnings.substr(begin, end - begin));
    begin = end + 2;
  }
  return list;
}

class Times {
 public:
  void add(const LogRecord& record) {
    if (!record.has_time) {
      ++missing_;
      return;
    }
    if (stamps_ > 0) {
      const double step = record.time - last_;
      backwards_ += step < 0.0;
      repeated_ += step == 0.0;
      if (step > 0.0) steps_.push_back(step);
      // The steps forward only: a stamp that leaps back must not shorten the run.
      duration_ += std::max(0.0, step);
    }
    ++stamps_;
    last_ = record.time;
  }

  double duration() const { return duration_; }

  Json faults() const {
    const double longest = kGapOfMedianSteps * median(steps_);
    const auto gaps =
        std::count_if(steps_.begin(), steps_.end(), [&](double step) { return step > longest; });
    return {
        {"missing", missing_}, {"backwards", backwards_}, {"repeated", repeated_}, {"gaps", gaps}};
  }

 private:
  std::size_t stamps_ = 0, missing_ = 0, backwards_ = 0, repeated_ = 0;
  std::vector<double> steps_;
  double last_ = 0.0, duration_ = 0.0;
};

class Ranges {
 public:
  void add(const Scan& scan) {
    for (const double range : scan.ranges) {
      no_returns_ += isNoReturn(range);
      ++beams_;
      if (!isReturn(range)) continue;
      ++returns_;
      shortest_ = std::min(shortest_, range);
      longest_ = std::max(longest_, range);
      ++histogram_[static_cast<std::size_t>(std::min(range / kRangeBin, kRangeBins - 1.0))];
    }
  }

  void write(Json& info) const {
    const auto share = [&](std::size_t count) {
      return beams_ == 0 ? 0.0
                         : rounded(static_cast<double>(count) / static_cast<double>(beams_), 1e-4);
    };
    info["returns"] = share(returns_);
    info["no_returns"] = share(no_returns_);
    info["invalid"] = share(beams_ - returns_ - no_returns_);
    info["range_m"] = returns_ == 0 ? Json::array() : Json{shortest_, medianRange(), longest_};
  }

 private:
  double medianRange() const {
    std::size_t below = 0, bin = 0;
    while (bin + 1 < kRangeBins && 2 * (below + histogram_[bin]) < returns_)
      below += histogram_[bin++];
    return rounded(kRangeBin * static_cast<double>(bin), kRangeBin);
  }

  std::size_t beams_ = 0, returns_ = 0, no_returns_ = 0;
  double shortest_ = std::numeric_limits<double>::infinity(), longest_ = 0.0;
  std::vector<std::size_t> histogram_ = std::vector<std::size_t>(kRangeBins, 0);
};

class Path {
 public:
  void add(const Pose2& pose) {
    if (begun_) {
      length_ += (pose.position() - last_.position()).norm();
      turning_ += std::abs(wrapAngle(pose.theta - last_.theta));
    }
    begun_ = true;
    last_ = pose;
  }
  double length() const { return length_; }
  double turning() const { return turning_; }

 private:
  Pose2 last_;
  bool begun_ = false;
  double length_ = 0.0, turning_ = 0.0;
};

/// Beams, angles and mountings of the lasers.
class Geometry {
 public:
  void add(const LogRecord& record) {
    least_ = std::min(least_, record.scan.size());
    most_ = std::max(most_, record.scan.size());
    if (most_ == record.scan.size()) shown_ = record.scan;
    const Pose2& mounting = record.T_robot_sensor;
    const bool known = std::any_of(mountings_.begin(), mountings_.end(), [&](const Pose2& other) {
      return areNear(other, mounting, kSameMounting);
    });
    if (!known) mountings_.push_back(mounting);
  }

  void write(Json& info) const {
    const double step = kDegreesPerRadian * shown_.angle_increment;
    const double gaps = most_ > 0 ? static_cast<double>(most_ - 1) : 0.0;
    info["beams"] = {most_ == 0 ? 0 : least_, most_};
    info["field_of_view_deg"] = rounded(std::abs(step) * gaps, 1e-3);
    info["first_beam_deg"] = rounded(kDegreesPerRadian * shown_.angle_min, 1e-3);
    info["beam_step_deg"] = rounded(step, 1e-5);
    Json& lasers = info["lasers"] = Json::array();
    for (const Pose2& m : mountings_) {
      lasers.push_back({{"x_m", rounded(m.x, 1e-4)},
                        {"y_m", rounded(m.y, 1e-4)},
                        {"yaw_deg", rounded(kDegreesPerRadian * m.theta, 1e-3)}});
    }
  }

 private:
  std::size_t least_ = std::numeric_limits<std::size_t>::max(), most_ = 0;
  Scan shown_;
  std::vector<Pose2> mountings_;
};

}  // namespace

Json inspectLog(LogReader& log) {
  std::size_t scans = 0, corrected = 0, odometry = 0, truth = 0;
  Geometry geometry;
  Ranges ranges;
  Times times;
  Path path;
  std::vector<double> noise;
  while (const auto record = log.next()) {
    ++scans;
    geometry.add(*record);
    ranges.add(record->scan);
    times.add(*record);
    path.add(record->scan.T_map_sensor * record->T_robot_sensor.inverse());
    noise.push_back(rangeNoise(record->scan).range_sigma);
    corrected += record->corrected.has_value();
    odometry += record->odometry.has_value();
    truth += record->truth.has_value();
  }
  Json info;
  info["scans"] = scans;
  geometry.write(info);
  ranges.write(info);
  info["noise_m"] = rounded(median(noise), 1e-4);
  info["duration_s"] = rounded(times.duration(), 1e-3);
  info["time_faults"] = times.faults();
  info["path_m"] = rounded(path.length(), 1e-3);
  info["turning_deg"] = rounded(kDegreesPerRadian * path.turning(), 0.1);
  info["poses"] = {{"corrected", corrected}, {"odometry", odometry}, {"truth", truth}};
  info["warnings"] = listed(log.warnings());
  return info;
}

}  // namespace cca
