// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cca_mrpt/io/log_reader.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

std::string flaser(std::size_t beams, double range, const Pose2& laser, const Pose2& odometry,
                   double time = 0.0, const std::string& name = "FLASER") {
  std::ostringstream line;
  line << name << " " << beams;
  for (std::size_t beam = 0; beam < beams; ++beam) line << " " << range + 0.01 * (beam % 7);
  for (const Pose2& p : {laser, odometry}) line << " " << p.x << " " << p.y << " " << p.theta;
  line << " " << time << " host " << time << "\n";
  return line.str();
}

class CarmenLog : public testing::Test {
 protected:
  std::string write(const std::string& text, const std::string& name = "some.log") const {
    const std::string path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }

  std::string zip(const std::string& text, const std::string& name = "some.log.gz") const {
    const std::string path = folder_ / name;
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path;
  }

  std::vector<LogRecord> readAll(const std::string& path) {
    const auto log = openLog(path);
    std::vector<LogRecord> records;
    while (auto record = log->next()) records.push_back(std::move(*record));
    warnings_ = log->warnings();
    return records;
  }

  TemporaryFolder folder_;
  std::string warnings_;
};

TEST_F(CarmenLog, BeamsFollowTheSickConventions) {
  const std::pair<std::size_t, double> last_beam_deg[] = {
      {180, 89.0}, {181, 90.0}, {360, 89.5}, {361, 90.0}, {91, 90.0}, {721, 90.0}, {541, 90.0}};
  for (const auto& [beams, last_deg] : last_beam_deg) {
    const auto records = readAll(write(flaser(beams, 3.0, {}, {})));
    ASSERT_EQ(records.size(), 1U);
    const Scan& scan = records[0].scan;
    ASSERT_EQ(scan.size(), beams);
    EXPECT_NEAR(scan.bearing(0), -90.0 * kRadiansPerDegree, 1e-12);
    EXPECT_NEAR(scan.bearing(beams - 1), last_deg * kRadiansPerDegree, 1e-9) << beams;
  }
}

TEST_F(CarmenLog, LaserPoseAndOdometryAreToldApart) {
  const Pose2 odometry{1.0, 2.0, 0.5}, mounting{0.3, 0.0, 0.0};
  const auto records = readAll(write(flaser(180, 3.0, odometry * mounting, odometry, 12.5)));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(records[0].T_robot_sensor.x, 0.3, 1e-4);
  EXPECT_NEAR(records[0].odometry->x, 1.0, 1e-9);
  EXPECT_NEAR(records[0].scan.T_map_sensor.x, 1.0 + 0.3 * std::cos(0.5), 1e-4);
  EXPECT_EQ(records[0].time, 12.5);
}

TEST_F(CarmenLog, RearLaserLooksBack) {
  const auto records = readAll(write(flaser(180, 3.0, {}, {}, 0.0, "RLASER")));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(std::abs(records[0].scan.T_map_sensor.theta), M_PI, 1e-9);
}

TEST_F(CarmenLog, RobotLaserTellsItsOwnAnglesAndMaximum) {
  const std::string line =
      "ROBOTLASER1 0 -2.0 4.0 1.0 30.0 0.01 0 5 1 2 30 29.99 4 2 7 7 "
      "1.5 2.5 0.25 1.25 2.5 0.25 0 0 0 0 0 77.5 host 77.5\n";
  const auto records = readAll(write(line));
  ASSERT_EQ(records.size(), 1U);
  const Scan& scan = records[0].scan;
  EXPECT_NEAR(scan.angle_min, -2.0, 1e-12);
  EXPECT_NEAR(scan.angle_increment, 1.0, 1e-12);
  EXPECT_TRUE(isNoReturn(scan.ranges[2]));
  EXPECT_TRUE(isNoReturn(scan.ranges[3]));
  EXPECT_EQ(scan.ranges[4], 4.0);
  EXPECT_EQ(scan.T_map_sensor.x, 1.5);
  EXPECT_EQ(records[0].odometry->x, 1.25);
  EXPECT_EQ(records[0].time, 77.5);
}

TEST_F(CarmenLog, SaturatedReadingsAreNoReturnsThatSayNothingOfFreeSpace) {
  std::string text;
  for (int k = 0; k < 10; ++k) {
    text += "FLASER 4 2.0 81.91 3.0 81.83 0 0 0 0 0 0 " + std::to_string(k) + " h 0\n";
  }
  const auto records = readAll(write(text));
  EXPECT_TRUE(isNoReturn(records[0].scan.ranges[1]));
  EXPECT_TRUE(isNoReturn(records[0].scan.ranges[3]));
  EXPECT_EQ(records[0].scan.free_range_without_return, 0.0);
}

TEST_F(CarmenLog, FarWallOfASmallRoomIsKept) {
  std::string wall = "FLASER 181";
  for (int beam = 0; beam <= 180; ++beam) wall += " " + std::to_string(5.0 + 0.001 * (beam % 90));
  const auto records = readAll(write(wall + " 0 0 0 0 0 0 1 h 1\n"));
  ASSERT_EQ(records.size(), 1U);
  ASSERT_EQ(records[0].scan.size(), 181U);
  for (const double range : records[0].scan.ranges) EXPECT_TRUE(isReturn(range));
}

TEST_F(CarmenLog, OdometryOfLogsThatGMappingRewroteIsPutTogetherAgain) {
  // The wheels say 1 m a scan along x; GMapping moves every pose to y = 5.
  std::string text;
  const auto odom = [](double x, double y) {
    return "ODOM " + std::to_string(x) + " " + std::to_string(y) + " 0 0 0 0 0 pippo 0\n";
  };
  for (int k = 0; k < 5; ++k) {
    const double x = 2.0 * k;  // corrected
    if (k > 0) text += odom(x - 1.5, 5.0) + odom(x - 1.0, 5.0);
    if (k == 0) text += odom(0.0, 0.0);
    text += flaser(180, 3.0 + 0.1 * k, {x, 5.0, 0.0}, {x, 5.0, 0.0}) + odom(x, 5.0) + "NEFF 30\n";
  }
  const auto records = readAll(write(text));
  ASSERT_EQ(records.size(), 5U);
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(records[k].corrected->x, 2.0 * k, 1e-9);
    ASSERT_TRUE(records[k].odometry.has_value());
    EXPECT_NEAR(records[k].odometry->x, 1.0 * k, 1e-9);
    EXPECT_NEAR(records[k].odometry->y, 0.0, 1e-9);
  }
}

TEST_F(CarmenLog, ZippedIsToldByContentNotByName) {
  const std::string text = "# CARMEN Logfile\n" + flaser(180, 3.0, {}, {});
  EXPECT_EQ(readAll(zip(text)).size(), 1U);
  EXPECT_EQ(readAll(zip(text, "misnamed.rawlog")).size(), 1U);
  EXPECT_EQ(readAll(write(text, "misnamed.gz")).size(), 1U);
}

TEST_F(CarmenLog, HalfAZippedLogIsReadAndSaid) {
  std::string text;
  for (int k = 0; k < 500; ++k) text += flaser(180, 2.0 + 0.37 * (k % 11), {0.1 * k, 0, 0}, {}, k);
  const std::string path = zip(text);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const auto records = readAll(path);
  EXPECT_GT(records.size(), 50U);
  EXPECT_LT(records.size(), 450U);
  EXPECT_THAT(warnings_, testing::HasSubstr("ends early"));
}

TEST_F(CarmenLog, DamagedLinesAreLeftOutAndCounted) {
  const std::string good = flaser(180, 3.0, {}, {});
  const std::string text = good + good.substr(0, 300) + "\n" + "FLASER -3 1 2\n" +
                           "FLASER 99999999 1 2\n" + "FLASER 3 1 x 2 0 0 0\n" +
                           "FLASER 2 1 2 nan 0 0 0 0 0 0 h 0\n" + std::string("\0\xff\n", 3) + good;
  EXPECT_EQ(readAll(write(text)).size(), 2U);
  EXPECT_THAT(warnings_, testing::HasSubstr("5 damaged"));
}

TEST_F(CarmenLog, WindowsLineEndsDoNotMatter) {
  std::string line = flaser(180, 3.0, {}, {}, 4.5);
  line.insert(line.size() - 1, "\r");
  const auto records = readAll(write(line));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].time, 4.5);
}

}  // namespace
}  // namespace cca
