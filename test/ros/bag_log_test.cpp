// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "cca_mrpt/io/log_reader.hpp"
#include "ros/messages/pose_message.hpp"

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

  void scan(double time, float range_max = 10.0F, const std::string& topic = "/scan") {
    sensor_msgs::LaserScan message;
    message.header.stamp = at(time);
    message.header.frame_id = "/laser";
    message.angle_min = -1.0F;
    message.angle_increment = 1.0F;
    message.range_min = 0.1F;
    message.range_max = range_max;
    message.ranges = {2.0F, HUGE_VALF, 0.05F};
    bag_.write(topic, recorded_.value_or(at(time)), message);
  }

  void odometry(const std::string& odom, const std::string& base, const Pose2& pose, double time) {
    nav_msgs::Odometry message;
    message.header.stamp = at(time);
    message.header.frame_id = odom;
    message.child_frame_id = base;
    message.pose.pose = poseMessage(pose);
    bag_.write("/odom", at(time), message);
  }

  std::unique_ptr<LogReader> open(const LogHints& hints = {}) {
    bag_.close();
    return openLog(path_, hints);
  }

  std::string refusal(const LogHints& hints) {
    try {
      open(hints);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
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

TEST_F(BagLog, OdometryMessagesAreInterpolatedAndTheirBaseIsTheRobots) {
  transform("chassis", "laser", {0.2, 0.0, M_PI}, 0.0, "/tf_static");
  odometry("wheels", "chassis", {1.0, 0.0, 0.0}, 0.0);
  odometry("wheels", "chassis", {2.0, 0.0, 0.0}, 1.0);
  scan(0.5);
  const auto log = open();
  const auto record = log->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_NEAR(record->odometry->x, 1.5, 1e-6);
  EXPECT_NEAR(record->T_robot_sensor.x, 0.2, 1e-6);
  EXPECT_NEAR(record->scan.T_map_sensor.x, 1.7, 1e-6);
  EXPECT_FALSE(log->next().has_value());
  EXPECT_EQ(log->warnings(), "");
}

TEST_F(BagLog, FramesWithAPrefixAreThoseOfTheRobot) {
  transform("robot1/base_link", "laser", {0.2, 0.0, 0.0}, 0.0, "/tf_static");
  transform("robot1/odom", "robot1/base_link", {1.0, 0.0, 0.0}, 0.0);
  scan(0.5);
  transform("robot1/odom", "robot1/base_link", {2.0, 0.0, 0.0}, 1.0);
  const auto record = open()->next();
  ASSERT_TRUE(record.has_value());
  ASSERT_TRUE(record->odometry.has_value());
  EXPECT_NEAR(record->odometry->x, 1.5, 1e-6);
  EXPECT_NEAR(record->scan.T_map_sensor.x, 1.7, 1e-6);
}

TEST_F(BagLog, ALaserWithoutAPlaceOnTheRobotIsNamed) {
  transform("odom", "base_link", {0.0, 0.0, 0.0}, 0.0);
  transform("odom", "base_link", {1.0, 0.0, 0.0}, 1.0);
  scan(0.5);
  const auto log = open();
  const auto record = log->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_NEAR(record->odometry->x, 0.5, 1e-6);
  log->next();
  EXPECT_THAT(log->warnings(),
              testing::HasSubstr("'laser' has no place on the robot ('base_link') in tf"));
}

TEST_F(BagLog, AMountThatIsToldStandsInForTf) {
  transform("odom", "base_link", {1.0, 0.0, 0.0}, 0.0);
  scan(0.0);
  const auto log = open({"", "", SensorMount{{0.1, 0.2, M_PI}, true}});
  const auto record = log->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_NEAR(record->T_robot_sensor.y, 0.2, 1e-9);
  EXPECT_NEAR(record->scan.T_map_sensor.x, 1.1, 1e-9);
  EXPECT_NEAR(record->scan.angle_increment, -1.0, 1e-9);
  log->next();
  EXPECT_EQ(log->warnings(), "");
}

TEST_F(BagLog, ABaseThatTfDoesNotKnowIsRefused) {
  transform("odom", "base_link", {}, 0.0);
  scan(0.0);
  EXPECT_THAT(refusal({"", "chassis", {}}),
              testing::HasSubstr("no such frame; it has 'base_link' 'odom'"));
}

TEST_F(BagLog, OfSeveralLasersTheOneThatIsReadIsTold) {
  for (const double time : {0.1, 0.2, 0.3}) scan(time, 10.0F, "/rear");
  scan(0.1, 20.0F, "/front");
  auto log = open();
  int scans = 0;
  while (log->next()) ++scans;
  EXPECT_EQ(scans, 3);
  EXPECT_THAT(log->warnings(),
              testing::StartsWith("the scans are those of '/rear' alone (--topic chooses), of "
                                  "'/front' (sensor_msgs/LaserScan, 1 messages), '/rear'"));
  log = open({"front", "", {}});
  scans = 0;
  while (log->next()) ++scans;
  EXPECT_EQ(scans, 1);
  EXPECT_THAT(refusal({"left", "", {}}), testing::HasSubstr("'left' holds no laser scans"));
}

TEST_F(BagLog, OfSeveralEchoesTheFirstIsRead) {
  sensor_msgs::MultiEchoLaserScan message;
  message.header.stamp = at(0.0);
  message.header.frame_id = "laser";
  message.angle_increment = 0.1F;
  message.range_max = 10.0F;
  message.ranges.resize(2);
  message.ranges[0].echoes = {2.0F, 4.0F};
  bag_.write("/echoes", at(0.0), message);
  const auto record = open()->next();
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->scan.ranges[0], 2.0);
  EXPECT_FALSE(isReturn(record->scan.ranges[1]));
}

TEST_F(BagLog, MayBeGzipped) {
  scan(0.1);
  scan(0.2);
  bag_.close();
  ASSERT_EQ(std::system(("gzip -kf " + path_).c_str()), 0);
  const std::string zipped = path_ + ".gz";
  const auto log = openLog(zipped);
  int scans = 0;
  while (log->next()) ++scans;
  EXPECT_EQ(scans, 2);
  std::filesystem::resize_file(zipped, std::filesystem::file_size(zipped) - 9);
  EXPECT_THROW(openLog(zipped), std::runtime_error);
  std::filesystem::remove(zipped);
}

TEST_F(BagLog, WithoutScansItsTopicsAreTold) {
  odometry("odom", "base_link", {}, 0.0);
  EXPECT_THAT(refusal({}), testing::HasSubstr("'/odom' (nav_msgs/Odometry, 1 messages)"));
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
  EXPECT_THAT(log->warnings(),
              testing::HasSubstr("1 impossible scan(s) left out: range_max must be positive and "
                                 "above range_min (range_max -1, range_min 0.1)"));
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
