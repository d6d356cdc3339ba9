// SPDX-License-Identifier: BSD-3-Clause
#include "held_odometry.hpp"

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "geometry/median.hpp"
#include "laser_place.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

/// Poses that tell whether scans hold them: some seconds, in which a robot turns and stops; at
/// least so many that a few of a robot that starts slowly do not decide.
constexpr std::size_t kAsked = 31, kLeastAsked = 9;
/// Share of the poses that one scan alone shows. Odometry that is fresh has nearly no others while
/// the robot moves; of odometry at two thirds of the laser's rate it is half of them.
constexpr double kMostFresh = 0.6;
/// Of the usual time from one pose to the next: odometry wavers by a scan or two, and a robot that
/// has stood for longer than this began to move within it.
constexpr double kLongestHeld = 1.5;
/// Scans read ahead for poses: ten seconds at forty a second, within which a robot begins to move.
constexpr std::size_t kMostAhead = 400;

/// Whether a robot can have driven so. Odometry that begins anew leaps.
bool isDriven(const Pose2& from, const Pose2& to, double seconds) {
  const Eigen::Vector3d step = difference(to, from);
  return step.head<2>().norm() < kFastest * seconds && std::abs(step.z()) < kFastestTurn * seconds;
}

class FreshLog : public LogReader {
 public:
  explicit FreshLog(std::unique_ptr<LogReader> log) : log_(std::move(log)) {}

  std::optional<LogRecord> next() override {
    while (!has_ended_ && !mayLeave()) {
      if (auto record = log_->next()) {
        take(std::move(*record));
      } else {
        has_ended_ = true;
      }
    }
    if (waiting_.empty()) return std::nullopt;
    Waiting left = std::move(waiting_.front());
    waiting_.pop_front();
    if (left.is_placed) refresh(left.record, left.shown);
    return std::move(left.record);
  }

  std::string warnings() const override { return log_->warnings(); }
  double progress() const override { return log_->progress(); }

 private:
  /// A pose of the odometry, from the first scan that shows it on.
  struct Shown {
    Pose2 T_odom_robot;
    double time;  ///< s, of that scan
    LaserPlace laser;
    std::size_t scans = 1;  ///< of that laser
  };
  struct Waiting {
    LogRecord record;
    bool is_placed;     ///< by the odometry, at a time
    std::size_t shown;  ///< the pose's number, from 0 in the log
  };
  /// From a pose to the next one.
  struct Hold {
    double seconds;
    bool is_fresh;  ///< one scan alone shows it
  };

  void take(LogRecord record) {
    const bool is_placed = record.odometry && record.has_time && !record.motion.middle;
    if (is_placed) {
      const LaserPlace laser = laserPlace(record.T_robot_sensor);
      newest_ = record.time;
      if (shown_.empty() || !areNear(shown_.back().T_odom_robot, *record.odometry, 0.0)) {
        if (!shown_.empty()) learn(record.time - shown_.back().time, shown_.back().scans);
        shown_.push_back({*record.odometry, record.time, laser});
      } else if (laser == shown_.back().laser) {
        ++shown_.back().scans;
      }
    }
    const std::size_t shown = first_shown_ + shown_.size();
    waiting_.push_back({std::move(record), is_placed, shown > 0 ? shown - 1 : 0});
  }

  void learn(double seconds, std::size_t scans) {
    if (!(seconds > 0.0)) return;
    holds_.push_back({seconds, scans == 1});
    if (holds_.size() > kAsked) holds_.pop_front();
    std::vector<double> times;
    for (const Hold& hold : holds_) times.push_back(hold.seconds);
    longest_ = kLongestHeld * median(std::move(times));
    fresh_ =
        std::count_if(holds_.begin(), holds_.end(), [](const Hold& hold) { return hold.is_fresh; });
  }

  bool knowsHolds() const { return holds_.size() >= kLeastAsked; }
  bool isHeld() const {
    const auto most = kMostFresh * static_cast<double>(holds_.size());
    return knowsHolds() && static_cast<double>(fresh_) <= most;
  }

  bool mayLeave() const {
    if (waiting_.empty()) return false;
    const Waiting& front = waiting_.front();
    if (!front.is_placed || waiting_.size() > kMostAhead) return true;
    if (!knowsHolds()) return false;
    const bool is_followed = front.shown + 1 < first_shown_ + shown_.size();
    return !isHeld() || is_followed || newest_ - front.record.time > longest_;
  }

  /// Brings the odometry of a record that leaves to its time.
  void refresh(LogRecord& record, std::size_t shown) {
    for (; first_shown_ < shown; ++first_shown_) shown_.pop_front();
    if (!isHeld() || shown_.size() < 2) return;
    const Shown &before = shown_[0], &after = shown_[1];
    const double from = std::max(before.time, after.time - longest_);
    if (!(record.time > from) || !(record.time < after.time)) return;
    if (!isDriven(before.T_odom_robot, after.T_odom_robot, after.time - from)) return;
    const double share = (record.time - from) / (after.time - from);
    record.odometry = poseBetween(before.T_odom_robot, after.T_odom_robot, share);
    if (!record.corrected) record.scan.T_map_sensor = *record.odometry * record.T_robot_sensor;
  }

  std::unique_ptr<LogReader> log_;
  std::deque<Waiting> waiting_;
  std::deque<Shown> shown_;  ///< from that of the first record that waits on
  std::size_t first_shown_ = 0;
  std::deque<Hold> holds_;
  double newest_ = 0.0;       ///< s, of the last record by odometry
  double longest_ = 0.0;      ///< s, before a pose, that the one before is taken to have been held
  std::ptrdiff_t fresh_ = 0;  ///< of the holds
  bool has_ended_ = false;
};

}  // namespace

std::unique_ptr<LogReader> withoutHeldOdometry(std::unique_ptr<LogReader> log) {
  return std::make_unique<FreshLog>(std::move(log));
}

}  // namespace cca
