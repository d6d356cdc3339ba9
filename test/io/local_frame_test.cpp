// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/local_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "io/files/stray_places.hpp"
#include "io/maps/occupancy_files.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

/// A log of given poses, with a scan of one beam each.
class PosesAsLog : public LogReader {
 public:
  explicit PosesAsLog(std::vector<Pose2> poses) : poses_(std::move(poses)) {}
  std::optional<LogRecord> next() override {
    if (at_ == poses_.size()) return std::nullopt;
    LogRecord record;
    record.scan.ranges = {1.0};
    record.scan.T_map_sensor = poses_[at_++];
    record.corrected = record.scan.T_map_sensor;
    record.odometry = Pose2{1.0, 2.0, 3.0};
    return record;
  }
  std::string warnings() const override { return ""; }
  double progress() const override { return 0.0; }

 private:
  std::vector<Pose2> poses_;
  std::size_t at_ = 0;
};

TEST(LocalFrame, LeavesWhatLiesNearTheOriginAsItIs) {
  EXPECT_EQ(localOrigin({499.0, -499.0}), Eigen::Vector2d(0, 0));
  EXPECT_EQ(localOrigin({4000.3, -1e7 + 2.0}), Eigen::Vector2d(4000, -1e7));
  EXPECT_EQ(localOrigin({std::nan(""), 1e5}), Eigen::Vector2d(0, 0));
}

TEST(LocalFrame, MovesALogToItsFirstScansAndLeavesItsOdometry) {
  std::vector<Pose2> poses{{-3e6, 1e200, 0.0}};  // the first has gone astray
  for (int k = 0; k < 200; ++k) poses.push_back({1e7 + 2.0 + 0.01 * k, 4e6 - 7.0, 0.5});
  LocalLog log(std::make_unique<PosesAsLog>(poses));
  EXPECT_EQ(log.origin(), Eigen::Vector2d(1e7, 4e6));
  EXPECT_NEAR(log.start().x(), 2.5, 1.0);
  std::size_t count = 0;
  while (const auto record = log.next()) {
    if (count == 7) {
      EXPECT_NEAR(record->scan.T_map_sensor.x, 2.06, 1e-8);
      EXPECT_NEAR(record->corrected->y, -7.0, 1e-8);
      EXPECT_EQ(record->odometry->x, 1.0);
    }
    ++count;
  }
  EXPECT_EQ(count, poses.size());
}

TEST(StrayPlaces, AreTheFewBeyondAWideGapAndAllThatAreFartherThanAPictureShows) {
  std::vector<Pose2> way;
  for (int k = 0; k < 19; ++k) way.push_back({0.1 * k, 0.0, 0.0});
  way.push_back({1e7, 0.0, 0.0});  // one of twenty
  const std::vector<bool> stray = findStrays(way);
  for (std::size_t k = 0; k < 19; ++k) EXPECT_FALSE(stray[k]) << k;
  EXPECT_TRUE(stray[19]);
  way.back().x = 5000.0;  // a second building
  EXPECT_FALSE(findStrays(way)[19]);
  EXPECT_TRUE(findStrays(std::vector<Pose2>{}).empty());
}

/// A wall at x = 3.02 m of the products' frame: not on the border of two cells, where far from the
/// origin rounding decides which of them it is in.
MapProducts wallSeenFrom(const Eigen::Vector2d& origin) {
  MapProducts products;
  products.origin = origin;
  MapLine line;
  line.segment.start = {3.02, -1.2345};
  line.segment.end = {3.02, 1.02};
  products.lines = {line};
  products.trajectory = {{0, 0, 0}, {1, 0.25, 0}};
  Scan scan;
  scan.angle_min = -0.3;
  scan.angle_increment = 0.01;
  for (std::size_t k = 0; k < 61; ++k) scan.ranges.push_back(3.02 / std::cos(scan.bearing(k)));
  ScanRaster grid;
  for (int k = 0; k < 5; ++k) grid.insert(scan);
  products.grid = grid.raster();
  return products;
}

TEST(MapFolder, IsRightToTheDigitFarFromTheOrigin) {
  const TemporaryFolder folder;
  writeMapFolder(folder / "near", wallSeenFrom({0, 0}));
  writeMapFolder(folder / "far", wallSeenFrom({1e7, -1e7}));
  const std::string lines = bytesOf(folder / "far/lines.csv");
  EXPECT_NE(lines.find("10000003.0200,-10000001.2345,10000003.0200,-9999998.9800"),
            std::string::npos)
      << lines;
  EXPECT_EQ(bytesOf(folder / "near/map.pgm"), bytesOf(folder / "far/map.pgm"));
  EXPECT_EQ(bytesOf(folder / "near/map.png"), bytesOf(folder / "far/map.png"));
  EXPECT_NE(
      bytesOf(folder / "far/map.yaml").find("origin: [10000000.000000, -10000000.950000, 0.0]"),
      std::string::npos)
      << bytesOf(folder / "far/map.yaml");
  EXPECT_NE(bytesOf(folder / "far/summary.json").find("frame_origin_m"), std::string::npos);
  const OccupancyRaster back = readOccupancyMap(folder / "far/map.yaml");
  const auto at = [&](double x, double y) {
    return back.at(back.cellOf({1e7 + x, -1e7 + y}), Occupancy::kUnknown);
  };
  EXPECT_EQ(at(3.02, 0.02), Occupancy::kOccupied);
  EXPECT_EQ(at(1.5, 0.02), Occupancy::kFree);
  EXPECT_EQ(at(3.5, 0.02), Occupancy::kUnknown);
}

TEST(MapFolder, OnePoseAtTheEndOfTheWorldCostsNoFile) {
  const TemporaryFolder folder;
  MapProducts products = wallSeenFrom({0, 0});
  products.trajectory.push_back({1e7, 0.0, 0.0});
  products.lines.push_back(products.lines.front());
  products.lines.back().segment.start.x() = 1e7;
  products.lines.back().segment.end.x() = 1e7;
  EXPECT_NO_THROW(writeMapFolder(folder / "map", products));
  EXPECT_TRUE(std::filesystem::exists(folder / "map/summary.json"));
}

}  // namespace
}  // namespace cca
