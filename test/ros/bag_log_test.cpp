// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/ros/bag_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/ros/pose_message.hpp"

namespace cca {
namespace {

class BagLog : public testing::Test {
 protected:
  static void SetUpTestSuite() { addBagLogs(); }
  void SetUp() override { bag_.open(path_, rosbag::bagmode::Write); }
  void TearDown() override { std::filesystem::remove(path_); }

  static ros::Time at(double seconds) { return ros::Time(1000.0 + seconds); }

  void transform(const std::string& parent, const std::string& child, const Pose2& pose,
                 double time, const std::string& topic = "/tf") {
    geometry_msgs::TransformStamped stamped;
    stamped.header.stamp = at(time);
    stamped.header.frame_id = parent;
    stamped.child_frame_id = child;
    stamped.transform = transformMessage(pose);
    tf2_msgs::TFMessage message;
    message.transforms.push_back(stamped);
    bag_.write(topic, recorded_.value_or(at(time)), message);
  }

  void scan(double time, float range_max = 10.0F) {
    sensor_msgs::LaserScan message;
    message.header.stamp = at(time);
    message.header.frame_id = "/laser";
    message.angle_min = -1.0F;
    message.angle_increment = 1.0F;
    message.range_min = 0.1F;
    message.range_max = range_max;
    message.ranges = {2.0F, HUGE_VALF, 0.05F};
    bag_.write("/scan", recorded_.value_or(at(time)), message);
  }

  std::unique_ptr<LogReader> open() {
    bag_.close();
    return openLog(path_);
  }

  const std::string path_ =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".bag";
  rosbag::Bag bag_;
  std::optional<ros::Time> recorded_;  ///< where it is not the time of the stamp
};

TEST_F(BagLog, PosesComeFromTfAtTheTimeOfTheScan) {
  transform("base_link", "laser", {0.2, 0.0, 0.0}, 0.0, "/tf_static");
  transform("map", "odom", {5.0, 0.0, 0.0}, 0.0, "/tf_static");
  transform("odom", "base_link", {0.0, 0.0, 0.0}, 0.0);
  scan(0.5);  // before the transform that it is interpolated from has been seen
  transform("odom", "base_link", {1.0, 0.0, 0.0}, 1.0);
  const auto log = open();
  const auto record = log->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_NEAR(record->odometry->x, 0.5, 1e-6);
  EXPECT_NEAR(record->corrected->x, 5.5, 1e-6);
  EXPECT_NEAR(record->scan.T_map_sensor.x, 5.7, 1e-6);
  EXPECT_NEAR(record->time, 1000.5, 1e-6);
  EXPECT_TRUE(isReturn(record->scan.ranges[0]));
  EXPECT_EQ(record->scan.freeRange(1), 0.0);  // a single missing return tells nothing
  for (const int beam : {1, 2}) EXPECT_FALSE(isReturn(record->scan.ranges[beam]));
  EXPECT_FALSE(log->next().has_value());
}

TEST_F(BagLog, OdometryMessagesStandInForTf) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = at(0.0);
  odometry.pose.pose = poseMessage({3.0, 4.0, 0.5});
  bag_.write("/odom", at(0.0), odometry);
  scan(0.1);
  const auto record = open()->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_FALSE(record->corrected.has_value());
  ASSERT_TRUE(record->odometry.has_value());
  EXPECT_NEAR(record->odometry->x, 3.0, 1e-9);
  EXPECT_NEAR(record->odometry->theta, 0.5, 1e-9);
}

TEST_F(BagLog, ScansAreNotPutIntoTwoFrames) {
  transform("base_link", "laser", {}, 0.0, "/tf_static");
  transform("odom", "base_link", {0.0, 0.0, 0.0}, 0.0);
  scan(0.1);  // `map` is not known yet
  transform("map", "odom", {50.0, 0.0, 0.0}, 0.2);
  scan(0.3);
  transform("map", "odom", {50.0, 0.0, 0.0}, 0.4);
  transform("odom", "base_link", {1.0, 0.0, 0.0}, 1.0);
  scan(0.8);  // `map` is not known any more
  const auto log = open();
  const auto record = log->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_NEAR(record->scan.T_map_sensor.x, 50.3, 1e-6);
  EXPECT_FALSE(log->next().has_value());
  EXPECT_THAT(log->warnings(), testing::HasSubstr("2 scan(s) that tf has no pose in 'map' for"));
}

TEST_F(BagLog, StampsMayRunFasterThanTheRecording) {
  transform("base_link", "laser", {}, 0.0, "/tf_static");
  for (int k = 0; k <= 200; ++k) {  // 100 simulated seconds in one of the recorder's
    recorded_ = at(0.005 * k);
    transform("map", "base_link", {0.01 * k, 0.0, 0.0}, 0.5 * k);
    scan(0.5 * k);
  }
  const auto log = open();
  int scans = 0;
  while (const auto record = log->next()) {
    EXPECT_NEAR(record->scan.T_map_sensor.x, 0.01 * scans, 1e-6);
    ++scans;
  }
  EXPECT_EQ(scans, 201);
  EXPECT_EQ(log->warnings(), "");
}

TEST_F(BagLog, DamageInTheMiddleEndsTheLogAndIsSaid) {
  for (int k = 0; k < 500; ++k) scan(0.01 * k);
  bag_.close();
  {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(path_) / 4));
    file << std::string(400, '\xFF');
  }
  const auto log = openLog(path_);
  int scans = 0;
  while (log->next()) ++scans;
  EXPECT_GT(scans, 10);
  EXPECT_LT(scans, 490);
  EXPECT_THAT(log->warnings(), testing::HasSubstr("unreadable from there on"));
}

TEST_F(BagLog, ImpossibleScansAreLeftOutAndSaid) {
  scan(0.1);
  scan(0.2, -1.0F);
  scan(0.3);
  const auto log = open();
  int scans = 0;
  while (log->next()) ++scans;
  EXPECT_EQ(scans, 2);
  EXPECT_THAT(log->warnings(), testing::HasSubstr("1 impossible"));
}

TEST_F(BagLog, WithoutScansIsRefused) {
  transform("odom", "base_link", {}, 0.0);
  EXPECT_THROW(open(), std::runtime_error);
}

TEST_F(BagLog, BrokenOffBagIsRefusedWithTheRemedy) {
  for (int k = 0; k < 500; ++k) scan(0.01 * k);
  bag_.close();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  try {
    openLog(path_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path_));
  }
}

}  // namespace
}  // namespace cca
