// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/resource.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cca_mrpt/io/log_reader.hpp"
#include "io/logs/rawlog_writer.hpp"
#include "io/mrpt/mrpt_scan.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

constexpr double kMaxRange = 10.0;

Scan someScan() {
  Scan scan;
  scan.angle_min = -0.7;
  scan.angle_increment = 0.1;
  scan.ranges = {1.0, 2.5, HUGE_VAL, 0.0, 3.25};
  return scan;
}

void expectSameScan(const Scan& read, const Pose2& T_robot_sensor, const Scan& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t beam = 0; beam < read.size(); ++beam) {
    EXPECT_EQ(isReturn(read.ranges[beam]), isReturn(written.ranges[beam])) << beam;
    EXPECT_EQ(isNoReturn(read.ranges[beam]), isNoReturn(written.ranges[beam])) << beam;
    if (isReturn(read.ranges[beam])) {
      EXPECT_NEAR(read.ranges[beam], written.ranges[beam], 1e-6);
    }
    EXPECT_NEAR(wrapAngle(T_robot_sensor.theta + read.bearing(beam) - written.bearing(beam)), 0.0,
                1e-6);
  }
}

void expectPose(const std::optional<Pose2>& pose, double x, double y, double theta) {
  ASSERT_TRUE(pose.has_value());
  EXPECT_NEAR(pose->x, x, 1e-6);
  EXPECT_NEAR(pose->y, y, 1e-6);
  EXPECT_NEAR(wrapAngle(pose->theta - theta), 0.0, 1e-6);
}

TEST(MrptScan, KeepsBearingsAndKindsOfReadings) {
  const auto there = toMrpt(someScan(), {}, kMaxRange, 5.0);
  const auto back = fromMrpt(there);
  ASSERT_TRUE(back.has_value());
  expectSameScan(back->scan, back->T_robot_sensor, someScan());
}

TEST(MrptScan, ClockwiseScansStayClockwise) {
  Scan scan = someScan();
  scan.angle_min = 0.4;
  scan.angle_increment = -0.2;
  const auto back = fromMrpt(toMrpt(scan, {}, kMaxRange));
  ASSERT_TRUE(back.has_value());
  expectSameScan(back->scan, back->T_robot_sensor, scan);
}

TEST(MrptScan, LaserUpsideDownSweepsMirrored) {
  auto observation = toMrpt(someScan(), {}, kMaxRange);
  observation.sensorPose = mrpt::poses::CPose3D(0.3, 0.0, 0.5, 0.0, 0.0, M_PI);
  const auto mounted = fromMrpt(observation);
  ASSERT_TRUE(mounted.has_value());
  EXPECT_LT(mounted->scan.angle_increment, 0.0);
  EXPECT_NEAR(mounted->T_robot_sensor.x, 0.3, 1e-9);
}

TEST(MrptScan, TiltedLaserGivesNothing) {
  auto observation = toMrpt(someScan(), {}, kMaxRange);
  observation.sensorPose = mrpt::poses::CPose3D(0, 0, 0.5, 0.0, 0.5, 0.0);
  EXPECT_FALSE(fromMrpt(observation).has_value());
}

TEST(Rawlog, WrittenRunReadsBackWithOdometryAndTimes) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.rawlog";
  const Pose2 mounting{0.2, 0.0, 0.0};
  const Pose2 poses[] = {{1.0, 2.0, 0.5}, {1.5, 2.2, 0.7}, {1.4, 2.9, -3.0}};
  {
    RawlogWriter writer(path, kMaxRange);
    for (int k = 0; k < 3; ++k) writer.insert(someScan(), mounting, poses[k], 0.25 * k);
    EXPECT_FALSE(std::filesystem::exists(path));
    writer.commit();
  }
  const auto log = openLog(path);
  for (int k = 0; k < 3; ++k) {
    const auto record = log->next();
    ASSERT_TRUE(record.has_value());
    EXPECT_TRUE(record->has_time);
    EXPECT_NEAR(record->time, 0.25 * k, 1e-6);
    expectPose(record->odometry, poses[k].x, poses[k].y, poses[k].theta);
    EXPECT_NEAR(record->T_robot_sensor.x, 0.2, 1e-6);
    expectSameScan(record->scan, record->T_robot_sensor, someScan());
    EXPECT_FALSE(record->corrected.has_value());
  }
  EXPECT_FALSE(log->next().has_value());
  EXPECT_EQ(log->warnings(), "");
}

TEST(Rawlog, TellsHowMuchOfItHasBeenRead) {
  const TemporaryFolder folder;
  {
    RawlogWriter writer(folder / "run.rawlog", kMaxRange);
    for (int k = 0; k < 200; ++k) writer.insert(someScan(), {}, {0.01 * k, 0.0, 0.0}, k);
    writer.commit();
  }
  const auto log = openLog(folder / "run.rawlog");
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(log->next());
  EXPECT_NEAR(log->progress(), 0.5, 0.02);  // scans alike are packed to a tenth
}

TEST(Rawlog, UncommittedRunLeavesNothingBehind) {
  const TemporaryFolder folder;
  { RawlogWriter writer(folder / "run.rawlog", kMaxRange); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Rawlog, PlainOdometryIsInterpolatedToTheScan) {
  const TemporaryFolder folder;
  const std::string path = folder / "plain.rawlog";
  {
    mrpt::io::CFileGZOutputStream file(path);
    auto archive = mrpt::serialization::archiveFrom(file);
    const auto odometry = [&](double time, double x, double theta) {
      mrpt::obs::CObservationOdometry observation;
      observation.timestamp = mrpt::Clock::fromDouble(time);
      observation.odometry = mrpt::poses::CPose2D(x, 0.0, theta);
      archive << observation;
    };
    odometry(10.0, 0.0, 3.1);
    archive << toMrpt(someScan(), {}, kMaxRange, 10.25);
    archive << toMrpt(someScan(), {}, kMaxRange, 10.75);
    odometry(11.0, 4.0, -3.1);
    archive << toMrpt(someScan(), {}, kMaxRange, 12.0);
  }
  const auto log = openLog(path);
  const double turn = 2.0 * (M_PI - 3.1);
  expectPose(log->next()->odometry, 1.0, 0.0, 3.1 + 0.25 * turn);
  expectPose(log->next()->odometry, 3.0, 0.0, 3.1 + 0.75 * turn);
  expectPose(log->next()->odometry, 4.0, 0.0, -3.1);
  EXPECT_FALSE(log->next().has_value());
}

TEST(Rawlog, ScansWithoutTimeStampSaySo) {
  const TemporaryFolder folder;
  const std::string path = folder / "untimed.rawlog";
  {
    mrpt::io::CFileGZOutputStream file(path);
    mrpt::serialization::archiveFrom(file) << toMrpt(someScan(), {}, kMaxRange);
  }
  EXPECT_FALSE(openLog(path)->next()->has_time);
}

TEST(Rawlog, TruncatedLogGivesWhatCouldBeRead) {
  const TemporaryFolder folder;
  const std::string whole = folder / "whole.rawlog", half = folder / "half.rawlog";
  RawlogWriter writer(whole, kMaxRange);
  Scan scan = someScan();
  scan.angle_increment = 0.01;
  // Noise, or it would compress into one block.
  for (int k = 0; k < 400; ++k) {
    scan.ranges.assign(181, 0.0);
    for (std::size_t b = 0; b < 181; ++b) scan.ranges[b] = 5.0 + std::sin(1e3 * k + 7e3 * b * b);
    writer.insert(scan, {}, {0.01 * k, 0.0, 0.0}, k);
  }
  writer.commit();
  std::filesystem::copy_file(whole, half);
  std::filesystem::resize_file(half, std::filesystem::file_size(whole) / 2);
  const auto log = openLog(half);
  int scans = 0;
  while (log->next()) ++scans;
  EXPECT_GT(scans, 100);
  EXPECT_LT(scans, 300);
  EXPECT_NE(log->warnings(), "");
}

/// A scan, where the wheels were, and a scan as a rawlog; the second scan claims another number of
/// beams than it has.
std::string logThatClaims(std::uint32_t beams) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << toMrpt(someScan(), {}, kMaxRange);
  mrpt::obs::CObservationOdometry wheels;
  wheels.timestamp = mrpt::Clock::fromDouble(1.0);
  archive << wheels;
  const std::size_t second = stream.getTotalBytesCount();
  archive << toMrpt(someScan(), {}, kMaxRange);
  std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                    stream.getTotalBytesCount());
  const float first_ranges[] = {1.0F, 2.5F};  // of someScan(); the count stands before them
  const std::string ranges(reinterpret_cast<const char*>(first_ranges), sizeof first_ranges);
  const std::size_t at = bytes.find(ranges, second) - sizeof beams;
  bytes.replace(at, sizeof beams, reinterpret_cast<const char*>(&beams), sizeof beams);
  return bytes;
}

TEST(Rawlog, AnObjectThatClaimsGigabytesIsRefusedBeforeItTakesThem) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends a program that asks for too much";
#endif
  const TemporaryFolder folder;
  const std::string path = folder / "claims.rawlog";
  for (const std::uint32_t beams : {100'000'000U, 2'000'000'000U, 4'294'967'295U}) {
    std::ofstream(path, std::ios::binary) << logThatClaims(beams);
    const auto log = openLog(path);
    EXPECT_TRUE(log->next().has_value());
    EXPECT_FALSE(log->next().has_value());
    EXPECT_THAT(log->warnings(), testing::HasSubstr("claims more"));
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  EXPECT_LT(used.ru_maxrss, 400'000);  // kB
}

/// A log of pairs of movement and scan, the second of which has one byte that MRPT trusts in vain.
TEST(Rawlog, OneWrongByteThatEndsItsReaderEndsTheLogOnly) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  for (int k = 0; k < 2; ++k) {
    mrpt::obs::CActionRobotMovement2D wheels;
    wheels.estimationMethod = mrpt::obs::CActionRobotMovement2D::emOdometry;
    wheels.rawOdometryIncrementReading = mrpt::poses::CPose2D(0.123456789, 0.0, 0.0);
    mrpt::obs::CActionCollection actions;
    actions.insert(wheels);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(
        std::make_shared<mrpt::obs::CObservation2DRangeScan>(toMrpt(someScan(), {}, kMaxRange)));
    archive << actions << frame;
  }
  const std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                          stream.getTotalBytesCount());
  const std::string name = "CActionRobotMovement2D";
  const std::size_t second = bytes.find(name, bytes.find(name) + 1) + name.size();
  const TemporaryFolder folder;
  // Whatever byte of the movement's head is wrong, the scans before it are there.
  for (std::size_t at = second; at < second + 24; ++at) {
    for (const char wrong : {'\x07', '\x7f', '\xff'}) {
      std::string damaged = bytes;
      damaged[at] = wrong;
      const std::string path = folder / "damaged.rawlog";
      std::ofstream(path, std::ios::binary) << damaged;
      const auto log = openLog(path);
      EXPECT_TRUE(log->next().has_value()) << at;
      while (log->next()) {
      }
    }
  }
}

TEST(SimpleMap, GivesStoredPosesAsCorrected) {
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<mrpt::obs::CObservation2DRangeScan>(
      toMrpt(someScan(), {0.1, 0.0, 0.0}, kMaxRange, 3.0)));
  const mrpt::poses::CPose3DPDFGaussian pose(mrpt::poses::CPose3D(4.0, 5.0, 0.0, 1.0, 0.0, 0.0));
  map.insert(pose, frame);
  const std::string path = folder / "some.simplemap";
  ASSERT_TRUE(map.saveToFile(path));
  const auto record = openLog(path)->next();
  ASSERT_TRUE(record.has_value());
  expectPose(record->corrected, 4.0, 5.0, 1.0);
  EXPECT_FALSE(record->odometry.has_value());
}

TEST(OpenLog, NamesFileAndReasonForWhatIsNoLog) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& content) {
    const std::string path = folder / name;
    std::ofstream(path, std::ios::binary) << content;
    try {
      openLog(path);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using testing::HasSubstr;
  EXPECT_THAT(message("empty.log", ""), HasSubstr("empty.log: is empty"));
  EXPECT_THAT(message("text.rawlog", "Dear reader,\nno log.\n"), HasSubstr("not a log of a known"));
  EXPECT_THAT(message("noise.log", std::string("\x01\x02\xff\x00\x83", 5)), HasSubstr("not a log"));
  EXPECT_THAT(message("odometry.log", "ODOM 0 0 0 0 0 0 0 h 0\n"), HasSubstr("laser scan"));
  EXPECT_THROW(openLog(folder / "missing.log"), std::runtime_error);
  EXPECT_THROW(openLog(folder.path()), std::runtime_error);
}

}  // namespace
}  // namespace cca
