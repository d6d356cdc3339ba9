// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cca_mrpt/io/log_reader.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

class TextLog : public testing::Test {
 protected:
  std::string write(const std::string& text) const {
    const std::string path = folder_ / "some.txt";
    std::ofstream(path) << text;
    return path;
  }

  std::vector<LogRecord> read(const std::string& text) {
    const auto log = openLog(write(text));
    std::vector<LogRecord> records;
    while (auto record = log->next()) records.push_back(std::move(*record));
    warnings_ = log->warnings();
    return records;
  }

  /// What is said of a log that cannot be read; empty where it can.
  std::string refusal(const std::string& text) {
    try {
      read(text);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  TemporaryFolder folder_;
  std::string warnings_;
};

std::string repeated(const std::string& text, std::size_t times, const std::string& between) {
  std::string all;
  for (std::size_t k = 0; k < times; ++k) all += (k == 0 ? "" : between) + text;
  return all;
}

// ---- CSV ---------------------------------------------------------------------------------------

TEST_F(TextLog, CsvNamesItsBeamsByTheirAngles) {
  const auto records = read(
      "stamp,x,y,theta,-90,-45,0,45,90\n"
      "1.5,1,2,0.5,1.0,1.1,1.2,inf,\n"
      "2.5,1.1,2,0.5,1.0,nan,1.2,-1,3\n");
  ASSERT_EQ(records.size(), 2U);
  const LogRecord& first = records[0];
  EXPECT_NEAR(first.scan.angle_min, -90 * kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(first.scan.angle_increment, 45 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(first.time, 1.5);
  EXPECT_TRUE(first.has_time);
  EXPECT_EQ(first.odometry->y, 2.0);
  EXPECT_EQ(first.scan.T_map_sensor.theta, 0.5);
  EXPECT_FALSE(first.corrected);
  EXPECT_EQ(first.scan.ranges[1], 1.1);
  EXPECT_TRUE(isNoReturn(first.scan.ranges[3]));
  for (const double invalid :
       {first.scan.ranges[4], records[1].scan.ranges[1], records[1].scan.ranges[3]}) {
    EXPECT_FALSE(isReturn(invalid) || isNoReturn(invalid));
  }
  EXPECT_EQ(warnings_, "");
}

TEST_F(TextLog, PosesInMillimetresAreWarnedOf) {
  const auto drive = [](double unit) {
    std::ostringstream text;
    text << "time,x,y,theta,-90,0,90\n";
    for (int k = 0; k < 10; ++k)
      text << 0.1 * k << "," << unit * 0.04 * k << ",0,0,2.1," << 9.0 - 0.04 * k << ",3\n";
    return text.str();
  };
  read(drive(1.0));
  EXPECT_EQ(warnings_, "");
  read(drive(1000.0));
  EXPECT_THAT(warnings_, testing::HasSubstr("poses look like millimetres (the robot would drive at "
                                            "400 m/s), and must be metres"));
}

TEST_F(TextLog, OdometryThatScansHaveHeldIsAsOfEachScan) {
  std::ostringstream text;
  text << "time,x,y,theta,-90,0,90\n";
  for (int k = 0; k < 80; ++k) {
    const int shown = k / 4 * 4;
    text << 0.025 * k << "," << 0.01 * shown << ",0,0,2.1," << 9.0 - 0.01 * k << ",3\n";
  }
  const auto records = read(text.str());
  ASSERT_EQ(records.size(), 80U);
  for (std::size_t k = 0; k < 76; ++k) {
    EXPECT_NEAR(records[k].odometry->x, 0.01 * static_cast<double>(k), 1e-9);
    EXPECT_NEAR(records[k].motion.middle->T_odom_sensor.x, 0.01 * static_cast<double>(k), 1e-9);
  }
}

TEST_F(TextLog, CsvOfASpreadsheetBeginsWithAMark) {
  EXPECT_EQ(read("\xEF\xBB\xBFstamp,-90,0,90\r\n1,2,2.5,3\r\n2,2,2.5,3\r\n").size(), 2U);
  EXPECT_EQ(read("\xEF\xBB\xBF# angle_min=-1 angle_max=1\nr0,r1,r2\n2,2.5,3\n").size(), 1U);
}

TEST_F(TextLog, CsvAnglesAreRadiansUnlessOneIsBeyondATurn) {
  const auto scan = read("-1.5;-0.5;0.5;1.5\n1;1;1;1\n")[0].scan;
  EXPECT_NEAR(scan.angle_min, -1.5, 1e-12);
  EXPECT_NEAR(scan.angle_increment, 1.0, 1e-12);
  const auto degrees = read("\"-1_deg\"\t\"0_deg\"\t\"1_deg\"\n1\t1\t1\n")[0].scan;
  EXPECT_NEAR(degrees.angle_increment, kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(read("90,0,-90\n1,2,3\n")[0].scan.angle_increment, -90 * kRadiansPerDegree, 1e-12);
}

TEST_F(TextLog, CsvOfRostopicEchoIsRead) {
  const auto records = read(
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.angle_min,"
      "field.angle_max,field.angle_increment,field.range_min,field.range_max,field.ranges0,"
      "field.ranges1,field.ranges2,field.intensities0\n"
      "1500000000500000000,7,1500000000250000000,laser,-0.5,0.5,0.5,0.1,10,0.05,3.5,60.0,9\n");
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(records[0].time, 1500000000.25, 1e-6);
  EXPECT_FALSE(records[0].odometry);
  const Scan& scan = records[0].scan;
  ASSERT_EQ(scan.size(), 3U);
  EXPECT_NEAR(scan.bearing(2), 0.5, 1e-12);
  EXPECT_FALSE(isReturn(scan.ranges[0]));
  EXPECT_EQ(scan.ranges[1], 3.5);
  EXPECT_FALSE(isReturn(scan.ranges[2]));
}

TEST_F(TextLog, CsvTellsItsAnglesAboveTheHeaderToo) {
  const auto records = read(
      "# Hokuyo of the lab, angle_min_deg=-30 angle_max_deg: 30, range_max=5.6\n\n"
      "time_ms,pose_x,pose_y,pose_yaw_deg,range_1,range_2,range_3\n"
      "# a comment\n"
      "2500,1,2,90,1,2,3\n");
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(records[0].time, 2.5, 1e-12);
  EXPECT_NEAR(records[0].scan.angle_min, -30 * kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(records[0].scan.angle_increment, 30 * kRadiansPerDegree, 1e-12);
  ASSERT_TRUE(records[0].corrected);
  EXPECT_NEAR(records[0].corrected->theta, M_PI / 2, 1e-12);
}

TEST_F(TextLog, CsvWithoutTimeOrPosesIsReadAsWell) {
  const auto records = read("-90,0,90\n1,2,3\n");
  ASSERT_EQ(records.size(), 1U);
  EXPECT_FALSE(records[0].has_time);
  EXPECT_FALSE(records[0].odometry);
}

TEST_F(TextLog, CsvThatIsMalformedIsRefusedByLineAndRule) {
  using testing::HasSubstr;
  const std::string path = folder_ / "some.txt";
  const std::pair<const char*, const char*> wrong[] = {
      {"stamp,ranges0,ranges1\n1,2,3\n", ":1: header: angle_min"},
      {"angle_min,angle_max,ranges0,ranges2\n", ":1: header: ranges must be numbered"},
      {"angle_min,angle_max,ranges0,ranges0\n", ":1: header: range 0 is there twice"},
      {"-90,0,150\n1,2,3\n", ":1: header: the angles that name the ranges must be spaced evenly"},
      {"1.2,3.4,2.2,1.1\n1,2,3,4\n", "a header that says the angles is needed"},
      {"-90,0,ranges0,ranges1\n", "one of both"},
      {"x,y,-90,0,90\n1,2,3,4,5\n", "a pose needs all of x, y, theta"},
      {"stamp,-90,0,90\n1,2,3\n",
       ":2: a row of 4 fields is needed, as the header has; there are 3"},
      {"stamp,-90,0,90\nnow,2,3,4\n", ":2: column 1: a finite number is needed, not 'now'"},
      {"stamp,-90,0,90\n1,2,far,4\n", ":2: column 3: a range is needed, not 'far'"},
      {"angle_min,angle_max,ranges0,ranges1\n-180,180,1,2\n", ":2: angles: 2 beams must lie apart"},
      {"angle_min,angle_increment,ranges0,ranges1\n-1,0,1,2\n", ":2: angles: 2 beams must lie"},
      {"stamp,-90,0,90\n", "holds no scan"},
  };
  for (const auto& [text, rule] : wrong) {
    EXPECT_THAT(refusal(text), HasSubstr(rule)) << text;
    EXPECT_THAT(refusal(text), HasSubstr(path)) << text;
  }
  EXPECT_THAT(refusal("x1,y1,x2,y2\n1,2,3,4\n"), HasSubstr("not a log of a known kind"));
}

TEST_F(TextLog, LaterLinesThatAreMalformedAreLeftOutWithAWarning) {
  const auto records = read("-90,0,90\n1,2,3\n1,2\n1,2,4\n1,x,4\n1,2,5\n");
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(warnings_,
            "2 line(s) left out, the first is line 3: a row of 3 fields is needed, as the header "
            "has; there are 2");
}

TEST_F(TextLog, MillimetresAreLeftOutByTheRuleOfAllLogs) {
  EXPECT_THAT(refusal("-90,0,90\n1500,2500,3500\n"), testing::HasSubstr("millimetres"));
}

// ---- csm ---------------------------------------------------------------------------------------

std::string csm(const std::string& readings, const std::string& more) {
  return "{ \"nrays\": 3, \"min_theta\": -1.0, \"max_theta\": 1.0, \"readings\": " + readings +
         more + " }\n";
}

TEST_F(TextLog, CsmTellsAnglesPosesAndWhatIsValid) {
  const auto records = read(
      csm("[ 1.5, null, 2.5 ]",
          ", \"theta\": [ -1.0, 0.0, 1.0 ], \"valid\": [ 1, 0, 0 ], \"odometry\": [ 1, 2, 0.5 ], "
          "\"estimate\": [ 1.1, 2, 0.5 ], \"true_pose\": [ null, null, null ], "
          "\"timestamp\": [ 46, 500000 ]"));
  ASSERT_EQ(records.size(), 1U);
  const LogRecord& record = records[0];
  EXPECT_NEAR(record.scan.bearing(1), 0.0, 1e-12);
  EXPECT_EQ(record.scan.ranges[0], 1.5);
  EXPECT_FALSE(isReturn(record.scan.ranges[1]) || isReturn(record.scan.ranges[2]));
  EXPECT_EQ(record.time, 46.5);
  EXPECT_EQ(record.odometry->x, 1.0);
  EXPECT_EQ(record.corrected->x, 1.1);
  EXPECT_EQ(record.scan.T_map_sensor.x, 1.1);
  EXPECT_FALSE(record.truth);
}

TEST_F(TextLog, CsmEstimatesThatRepeatTheOdometryCorrectNothing) {
  const auto records = read(csm("[ 1, 2, 3 ]", ", \"odometry\": [1,2,3], \"estimate\": [1,2,3]") +
                            csm("[ 1, 2, 4 ]", ", \"estimate\": [ null, null, null ]"));
  ASSERT_EQ(records.size(), 2U);
  EXPECT_FALSE(records[0].corrected);
  EXPECT_TRUE(records[0].odometry);
  EXPECT_FALSE(records[0].has_time);
  EXPECT_FALSE(records[1].odometry || records[1].corrected);
}

TEST_F(TextLog, CsmThatIsMalformedIsRefusedByLineAndRule) {
  const std::pair<std::string, const char*> wrong[] = {
      {"{ \"nrays\": 3, \"min_theta\": -1.0\n", ":1: a JSON object is needed, whole on this line"},
      {csm("[ 1, 2 ]", ""), ":1: readings: an array of 3 is needed, not of 2"},
      {csm("null", ""), ":1: readings: are missing"},
      {csm("[ 1, 2, 3 ]", ", \"valid\": 1"), ":1: valid: an array of 3 is needed"},
      {csm("[ 1, 2, 3 ]", ", \"theta\": [ -1, 0.9, 1 ]"), "ray 1 is not"},
      {"\n{ \"nrays\": -3, \"min_theta\": 0, \"max_theta\": 1, \"readings\": [] }\n",
       ":2: nrays: a"},
      {"{ \"nrays\": 3, \"min_theta\": 0, \"max_theta\": \"wide\", \"readings\": [] }\n",
       ":1: max_theta: a finite number is needed"},
      {"{ \"nrays\": 1e9, \"min_theta\": 0, \"max_theta\": 1, \"readings\": [] }\n", "nrays"},
      {"{ \"nrays\": 3, \"min_theta\": 0, \"max_theta\": 90, \"readings\": [1,2,3] }\n",
       "angles: 3"},
  };
  for (const auto& [text, rule] : wrong) EXPECT_THAT(refusal(text), testing::HasSubstr(rule));
}

// ---- CoreSLAM ----------------------------------------------------------------------------------

/// @param ticks  "left right". @param before  numbers before the ranges.
std::string coreSlam(const std::string& microseconds, const std::string& ticks,
                     const std::string& ranges, std::size_t before = 25) {
  return microseconds + " 14710 " + ticks + " " + repeated("0", before - 4, " ") + "  " + ranges +
         " \n";
}

TEST_F(TextLog, CoreSlamTellsTimeWheelsAndRangesOfItsHokuyo) {
  const auto ranges = [](const std::string& wall) {
    return repeated("500", 70, " ") + " 0 7 " + repeated(wall, 540, " ") + " " +
           repeated("500", 70, " ");
  };
  const auto records = read(coreSlam("212387282", "29221 25178", ranges("2500")) +
                            coreSlam("212487282", "31221 27178", ranges("2400")) +
                            coreSlam("212587282", "30721 27678", ranges("2300"), 24));
  ASSERT_EQ(records.size(), 3U);
  const Scan& scan = records[0].scan;
  ASSERT_EQ(scan.size(), 682U);
  EXPECT_NEAR(records[0].time, 212.387282, 1e-9);
  EXPECT_NEAR(scan.bearing(340), 0.0, 1e-12);  // step 384 of the laser
  EXPECT_NEAR(scan.bearing(0), -119.53125 * kRadiansPerDegree, 1e-9);
  EXPECT_FALSE(isReturn(scan.ranges[69]) || isReturn(scan.ranges[612]));  // its own robot
  EXPECT_TRUE(isNoReturn(scan.ranges[70]));
  EXPECT_FALSE(isReturn(scan.ranges[71]) || isNoReturn(scan.ranges[71]));  // a code of an error
  EXPECT_EQ(scan.ranges[72], 2.5);
  // A turn of both wheels of 77 mm; then a quarter turn of each, against one another.
  EXPECT_NEAR(records[1].odometry->x, 2 * M_PI * 0.077, 1e-9);
  EXPECT_NEAR(records[1].odometry->theta, 0.0, 1e-12);
  EXPECT_NEAR(records[2].odometry->theta, M_PI * 0.077 / 0.33, 1e-9);
  EXPECT_NEAR(records[2].odometry->x, 2 * M_PI * 0.077, 1e-9);
  EXPECT_NEAR(records[0].T_robot_sensor.x, 0.145, 1e-12);
}

TEST_F(TextLog, CoreSlamThatIsMalformedIsRefusedByLineAndRule) {
  EXPECT_THAT(refusal(coreSlam("1", "2 3", repeated("500", 360, " "))),
              testing::HasSubstr(":1: 24 or 25 numbers, and then the 682 ranges of a URG-04LX, are "
                                 "needed; there are 385 numbers"));
  EXPECT_THAT(refusal(coreSlam("nan", "2 3", repeated("500", 682, " "))),
              testing::HasSubstr(":1: time and wheel ticks"));
  const std::string good = coreSlam("1", "2 3", repeated("500", 682, " "));
  EXPECT_EQ(read(good + "1 2 3\n" + good).size(), 2U);
  EXPECT_THAT(warnings_, testing::HasSubstr("1 line(s) left out, the first is line 2"));
}

// ---- relatives of CARMEN -----------------------------------------------------------------------

TEST_F(TextLog, CarmenLinesWithoutStampsHaveNoTime) {
  const std::string scan = "FLASER 4 2.0 2.1 2.2 2.3 1 2 0.5 1.1 2 0.5";
  const auto without = read(scan + "\n" + scan + "\n");
  ASSERT_EQ(without.size(), 2U);
  EXPECT_FALSE(without[0].has_time);
  EXPECT_EQ(without[0].odometry->x, 1.1);
  EXPECT_TRUE(read(scan + " 12.5 host 12.6\n")[0].has_time);
  const auto of_one_pose =
      read("FLASER 4 2.0 2.1 2.2 2.3 1 2 0.5 976052857.33 nohost 976052857.4\n");
  EXPECT_NEAR(of_one_pose[0].time, 976052857.33, 1e-6);
}

std::string rawLaser(double time, double range, int number = 1) {
  std::ostringstream line;
  line << "RAWLASER" << number << " 0 -1.0 2.0 1.0 30.0 0.01 0 3 " << range << " 4 5 0 " << time
       << " host 0\n";
  return line.str();
}

TEST_F(TextLog, RawCarmenLasersStandAtTheOdometryAboutThem) {
  const auto records =
      read("ODOM 0 0 0 0 0 0 10.0 host 0\n" + rawLaser(10.25, 1.0) + rawLaser(10.5, 2.0) +
           "ODOM 1 0 1 0 0 0 11.0 host 0\n" + rawLaser(11.5, 3.0));
  ASSERT_EQ(records.size(), 3U);
  EXPECT_NEAR(records[0].odometry->x, 0.25, 1e-12);
  EXPECT_NEAR(records[1].odometry->theta, 0.5, 1e-12);
  EXPECT_NEAR(records[2].odometry->x, 1.0, 1e-12);
  EXPECT_EQ(records[2].scan.ranges[0], 3.0);
  EXPECT_NEAR(records[0].scan.bearing(2), 1.0, 1e-12);
  EXPECT_FALSE(read(rawLaser(1.0, 1.0) + rawLaser(2.0, 1.5))[1].odometry);
}

TEST_F(TextLog, RawCarmenLasersGiveWayToThoseWithPoses) {
  const auto records = read(repeated(rawLaser(1.0, 1.0), 3, "") +
                            "FLASER 4 2.0 2.1 2.2 2.3 1 2 0.5 1 2 0.5 1 h 1\n");
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].scan.size(), 4U);
}

TEST_F(TextLog, ASecondRawCarmenLaserLooksBack) {
  const auto records = read("ODOM 1 2 0 0 0 0 10.0 host 0\n" + rawLaser(10.0, 1.0, 2) +
                            "ODOM 1 2 0 0 0 0 11.0 host 0\n" + rawLaser(11.0, 1.5, 2));
  ASSERT_EQ(records.size(), 2U);
  EXPECT_NEAR(std::abs(records[0].T_robot_sensor.theta), M_PI, 1e-12);
  EXPECT_NEAR(std::abs(records[0].scan.T_map_sensor.theta), M_PI, 1e-12);
  EXPECT_NEAR(records[0].scan.T_map_sensor.y, 2.0, 1e-12);
  EXPECT_EQ(warnings_, "");
}

TEST_F(TextLog, CarmenLasersThatNobodyPlacesAreToldOf) {
  const std::string others = rawLaser(1.0, 7.0, 2) + rawLaser(1.0, 8.0, 3) + rawLaser(2.0, 8.0, 3) +
                             "LASER4 3 9 9 9 1 host 1\n";
  const auto records = read(rawLaser(1.0, 1.0) + others);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].scan.ranges[0], 1.0);
  EXPECT_THAT(warnings_, testing::HasSubstr("1 LASER4 line(s) left out: where on the robot"));
  EXPECT_THAT(warnings_, testing::HasSubstr("1 RAWLASER2 line(s) left out"));
  EXPECT_THAT(warnings_, testing::HasSubstr("2 RAWLASER3 line(s) left out"));
}

TEST_F(TextLog, ALogOfCarmenLasersThatNobodyPlacesIsRefused) {
  EXPECT_THAT(refusal(repeated("LASER3 3 9 9 9 1 host 1\n", 4, "")),
              testing::HasSubstr("4 LASER3 line(s) left out: where on the robot"));
}

}  // namespace
}  // namespace cca
