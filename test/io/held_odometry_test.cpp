// SPDX-License-Identifier: BSD-3-Clause
#include "io/logs/held_odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <vector>

namespace cca {
namespace {

constexpr double kScans = 40.0, kPoses = 10.0;  // per second

class Records : public LogReader {
 public:
  explicit Records(std::vector<LogRecord> records) : left_(records.begin(), records.end()) {}

  std::optional<LogRecord> next() override {
    if (left_.empty()) return std::nullopt;
    LogRecord record = std::move(left_.front());
    left_.pop_front();
    return record;
  }
  std::string warnings() const override { return "as the log says"; }
  double progress() const override { return 0.5; }

 private:
  std::deque<LogRecord> left_;
};

using Drive = std::function<Pose2(double time)>;

Pose2 onACircle(double time) {
  return {2.0 * std::sin(0.4 * time), 2.0 - 2.0 * std::cos(0.4 * time), wrapAngle(0.4 * time)};
}

/// @param rate  of the odometry, per second, of which a scan holds the last pose before it.
std::vector<LogRecord> scansOf(const Drive& drive, double seconds, double rate = kPoses) {
  std::vector<LogRecord> records;
  for (int k = 0; k < seconds * kScans; ++k) {
    LogRecord record;
    record.time = k / kScans;
    record.T_robot_sensor = {0.2, 0.0, 0.0};
    record.odometry = drive(std::floor(record.time * rate + 1e-9) / rate);
    record.scan.T_map_sensor = *record.odometry * record.T_robot_sensor;
    records.push_back(record);
  }
  return records;
}

std::vector<LogRecord> freshened(const std::vector<LogRecord>& records) {
  const auto log = withoutHeldOdometry(std::make_unique<Records>(records));
  std::vector<LogRecord> fresh;
  while (auto record = log->next()) fresh.push_back(std::move(*record));
  return fresh;
}

double distance(const Pose2& a, const Pose2& b) { return (a.position() - b.position()).norm(); }

/// The first scan whose pose is not, to the bit, as it was; their number where all are.
std::size_t firstChanged(const std::vector<LogRecord>& before,
                         const std::vector<LogRecord>& after) {
  EXPECT_EQ(before.size(), after.size());
  std::size_t k = 0;
  while (k < before.size() && difference(*before[k].odometry, *after[k].odometry).isZero(0.0)) ++k;
  return k;
}

TEST(HeldOdometry, IsBroughtToTheTimeOfEachScan) {
  const auto held = scansOf(onACircle, 20.0);
  const auto fresh = freshened(held);
  ASSERT_EQ(fresh.size(), held.size());
  double worst = 0.0, worst_held = 0.0, worst_turn = 0.0;
  for (std::size_t k = 0; k + 4 < fresh.size(); ++k) {  // nothing follows on the last pose
    const Pose2 truth = onACircle(fresh[k].time);
    worst = std::max(worst, distance(*fresh[k].odometry, truth));
    worst_held = std::max(worst_held, distance(*held[k].odometry, truth));
    worst_turn = std::max(worst_turn, std::abs(difference(*fresh[k].odometry, truth).z()));
    const Pose2 sensor = *fresh[k].odometry * fresh[k].T_robot_sensor;
    EXPECT_EQ(distance(fresh[k].scan.T_map_sensor, sensor), 0.0);
  }
  EXPECT_GT(worst_held, 0.05);
  EXPECT_LT(worst, 0.001);
  EXPECT_LT(worst_turn, 1e-9);
}

TEST(HeldOdometry, OfARobotThatBeginsToMoveIsLeftJustBeforeItDoes) {
  const Drive drive = [](double time) {
    return Pose2{time < 30.0 ? 0.5 * std::min(time, 4.0) : 2.0 + 0.5 * (time - 30.0), 0.0, 0.0};
  };
  const auto fresh = freshened(scansOf(drive, 40.0));
  for (const LogRecord& record : fresh) {
    if (record.time > 39.9) continue;  // nothing follows on the last pose
    EXPECT_NEAR(record.odometry->x, drive(record.time).x, 0.02) << record.time;
    const bool stands = record.time > 4.0 && record.time < 29.9;
    EXPECT_TRUE(!stands || record.odometry->x == 2.0) << record.time;
  }
}

TEST(HeldOdometry, CorrectedPosesStay) {
  auto held = scansOf(onACircle, 5.0);
  for (LogRecord& record : held) record.corrected = Pose2{7.0, 0.0, 0.0};
  const auto fresh = freshened(held);
  EXPECT_LT(firstChanged(held, fresh), 4U);
  for (std::size_t k = 0; k < held.size(); ++k) {
    EXPECT_EQ(distance(fresh[k].scan.T_map_sensor, held[k].scan.T_map_sensor), 0.0);
  }
}

TEST(HeldOdometry, IsNotSpreadOverALeap) {
  const Drive begins_anew = [](double time) {
    return time < 10.0 ? onACircle(time) : onACircle(time - 10.0);
  };
  const auto held = scansOf(begins_anew, 20.0);
  const auto fresh = freshened(held);
  for (std::size_t k = 396; k < 400; ++k) {
    EXPECT_EQ(distance(*fresh[k].odometry, *held[k].odometry), 0.0) << k;
  }
  EXPECT_GT(distance(*fresh[399].odometry, *fresh[400].odometry), 1.0);
}

TEST(HeldOdometry, ThatIsFreshStaysToTheBit) {
  const Drive stops = [](double time) { return onACircle(std::min(time, 10.0)); };
  const Drive stops_often = [](double time) {
    return onACircle(std::floor(time) + std::max(0.0, time - std::floor(time) - 0.5));
  };
  for (const Drive& drive : {Drive(onACircle), stops, stops_often}) {
    const auto records = scansOf(drive, 20.0, kScans);
    EXPECT_EQ(firstChanged(records, freshened(records)), records.size());
  }
}

TEST(HeldOdometry, OfARobotThatStandsStaysToTheBit) {
  const auto records = scansOf([](double) { return Pose2{1.0, 2.0, 0.5}; }, 30.0);
  EXPECT_EQ(firstChanged(records, freshened(records)), records.size());
}

TEST(HeldOdometry, OfTwoLasersThatShareAPoseStaysToTheBit) {
  std::vector<LogRecord> records;
  for (const LogRecord& front : scansOf(onACircle, 10.0, kScans)) {
    records.push_back(front);
    records.push_back(front);
    records.back().T_robot_sensor = {-0.2, 0.0, M_PI};
    records.back().time += 0.01;
  }
  EXPECT_EQ(firstChanged(records, freshened(records)), records.size());
}

TEST(HeldOdometry, StaysWhereTimesOrSweepsSayOtherwise) {
  auto without_time = scansOf(onACircle, 10.0);
  for (LogRecord& record : without_time) record.has_time = false;
  EXPECT_EQ(firstChanged(without_time, freshened(without_time)), without_time.size());
  auto with_motion = scansOf(onACircle, 10.0);
  for (LogRecord& record : with_motion) record.motion.middle = SensorReading{Pose2{}, record.time};
  EXPECT_EQ(firstChanged(with_motion, freshened(with_motion)), with_motion.size());
}

}  // namespace
}  // namespace cca
