// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/metric_map.hpp"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "io/mrpt/mrpt_scan.hpp"

namespace cca {
namespace {

constexpr double kHalfRoom = 3.0;  // m, half the side of a square room around the map's origin

/// What a laser of 361 beams sees at a place inside the room.
mrpt::obs::CObservation2DRangeScan scanAt(const Pose2& T_map_robot) {
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = 2.0 * M_PI / 360.0;
  for (int beam = 0; beam < 361; ++beam) {
    const double bearing = scan.angle_min + beam * scan.angle_increment + T_map_robot.theta;
    const double c = std::cos(bearing), s = std::sin(bearing);
    const double rx = c == 0.0 ? INFINITY : ((c > 0 ? kHalfRoom : -kHalfRoom) - T_map_robot.x) / c;
    const double ry = s == 0.0 ? INFINITY : ((s > 0 ? kHalfRoom : -kHalfRoom) - T_map_robot.y) / s;
    scan.ranges.push_back(std::min(rx, ry));
  }
  return toMrpt(scan, Pose2{}, 80.0);
}

mrpt::poses::CPose3D pose3(const Pose2& p) { return {p.x, p.y, 0.0, p.theta, 0.0, 0.0}; }

const Pose2 kPlaces[] = {{0.0, 0.0, 0.0}, {0.5, -0.4, 0.3}, {-0.6, 0.2, -1.0}, {0.1, 0.7, 2.0}};

void mapRoom(mrpt::maps::CMetricMap& map) {
  for (const Pose2& p : kPlaces) EXPECT_TRUE(map.insertObservation(scanAt(p), pose3(p)));
}

double largestDistanceFromRoom(const std::vector<MapLine>& lines) {
  double largest = 0.0;
  for (const MapLine& line : lines) {
    for (const auto& end : {line.segment.start, line.segment.end}) {
      largest = std::max(largest, std::abs(end.cwiseAbs().maxCoeff() - kHalfRoom));
    }
  }
  return largest;
}

TEST(CLineMap2D, MapsARoomFromMrptsScans) {
  CLineMap2D map;
  EXPECT_TRUE(map.isEmpty());
  mapRoom(map);
  EXPECT_GE(map.lines().size(), 4u);
  EXPECT_LT(largestDistanceFromRoom(map.lines()), 0.02);
  map.clear();
  EXPECT_TRUE(map.isEmpty());
}

TEST(CLineMap2D, IsMadeByAMultiMetricMapFromItsIni) {
  mrpt::config::CConfigFileMemory ini;
  ini.setContent(
      "[map]\nlineMap_count = 1\n[map_lineMap_00_insertOpts]\nvertex_price = 9\n"
      "[map_lineMap_00_likelihoodOpts]\nsigma = 0.25\n");
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(ini, "map");
  mrpt::maps::CMultiMetricMap maps(definitions);
  const auto map = maps.mapByClass<CLineMap2D>();
  ASSERT_TRUE(map);
  EXPECT_DOUBLE_EQ(map->insertionOptions().vertex_price, 9.0);
  EXPECT_DOUBLE_EQ(map->likelihood_options.sigma, 0.25);
  mapRoom(maps);
  EXPECT_GE(map->lines().size(), 4u);
}

TEST(CLineMap2D, AFileThatAnIniNamesIsWhereItBegins) {
  CLineMap2D map;
  mapRoom(map);
  const std::string path = testing::TempDir() + "room.linemap.gz";
  writeLineMap(path, map.lines());
  mrpt::config::CConfigFileMemory ini;
  ini.setContent("[map]\nlineMap_count = 1\n[map_lineMap_00_creationOpts]\nfile = " + path + "\n");
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(ini, "map");
  mrpt::maps::CMultiMetricMap maps(definitions);
  const auto read = maps.mapByClass<CLineMap2D>();
  ASSERT_TRUE(read);
  ASSERT_EQ(read->lines().size(), map.lines().size());
  EXPECT_EQ(read->lines().back().segment.end, map.lines().back().segment.end);
  EXPECT_NEAR(read->squareDistanceToClosestCorrespondence(2.0F, 0.0F), 1.0, 0.05);
}

TEST(CLineMap2D, AFileThatIsNoneIsRefusedByName) {
  const std::string path = testing::TempDir() + "none.linemap.gz";
  for (const char* content : {"", "x1,y1,x2,y2\n",
                              "\x8f"
                              "cca::CLineMap2D\x00\x00\x00"}) {
    std::ofstream(path) << content;
    try {
      readLineMap(path);
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0u) << error.what();
    }
  }
}

TEST(CLineMap2D, RefusesAnIniValueOutOfRangeByName) {
  mrpt::config::CConfigFileMemory ini;
  ini.setContent("[map]\nlineMap_count = 1\n[map_lineMap_00_insertOpts]\nsimilarity_cut = 7\n");
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  try {
    definitions.loadFromConfigFile(ini, "map");
    FAIL() << "no error";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("similarity_cut"), std::string::npos);
  }
}

TEST(CLineMap2D, ComesBackFromAStreamLineByLine) {
  CLineMap2D map;
  mapRoom(map);
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  stream.Seek(0);
  const auto object = archive.ReadObject();
  const auto* read = dynamic_cast<const CLineMap2D*>(object.get());
  ASSERT_TRUE(read);
  const auto before = map.lines(), after = read->lines();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(before[k].id, after[k].id);
    EXPECT_EQ(before[k].support, after[k].support);
    EXPECT_EQ(before[k].segment.start, after[k].segment.start);
    EXPECT_EQ(before[k].segment.end, after[k].segment.end);
    EXPECT_EQ(before[k].segment.covariance, after[k].segment.covariance);
    EXPECT_EQ(before[k].segment.moments.scatter, after[k].segment.moments.scatter);
  }
}

TEST(CLineMap2D, ACopyGrowsOnItsOwn) {
  CLineMap2D map;
  const auto first = scanAt(kPlaces[0]);
  map.insertObservation(first, pose3(kPlaces[0]));
  const double support = map.lines().front().support;
  CLineMap2D copy(map);
  mapRoom(copy);
  EXPECT_GT(copy.lines().front().support, support);
  EXPECT_EQ(map.lines().front().support, support);
}

TEST(CLineMap2D, LikelihoodIsHighestAtTheTruePose) {
  CLineMap2D map;
  mapRoom(map);
  const Pose2 truth{0.3, 0.2, 0.5};
  const auto scan = scanAt(truth);
  ASSERT_TRUE(map.canComputeObservationLikelihood(scan));
  const double at_truth = map.computeObservationLikelihood(scan, pose3(truth));
  for (const Pose2& off : {Pose2{0.4, 0.2, 0.5}, Pose2{0.3, 0.1, 0.5}, Pose2{0.3, 0.2, 0.55},
                           Pose2{0.3, 0.2, 0.45}, Pose2{-2.0, 1.0, -1.0}}) {
    EXPECT_GT(at_truth, map.computeObservationLikelihood(scan, pose3(off)));
  }
}

TEST(CLineMap2D, DistanceIsThatOfTheNearestLine) {
  CLineMap2D map;
  EXPECT_TRUE(std::isinf(map.squareDistanceToClosestCorrespondence(0.0F, 0.0F)));
  mapRoom(map);
  EXPECT_NEAR(map.squareDistanceToClosestCorrespondence(2.0F, 0.0F), 1.0, 0.05);
}

TEST(CLineMap2D, ShowsItsLinesInThreeDimensions) {
  CLineMap2D map;
  mapRoom(map);
  mrpt::opengl::CSetOfObjects objects;
  map.getVisualizationInto(objects);
  const auto lines = objects.getByClass<mrpt::opengl::CSetOfLines>();
  ASSERT_TRUE(lines);
  EXPECT_EQ(lines->getLineCount(), 4 * map.lines().size());
}

TEST(CLineMap2D, SavesItsLinesAsFiles) {
  CLineMap2D map;
  mapRoom(map);
  const std::string prefix = testing::TempDir() + "metric_map";
  map.saveMetricMapRepresentationToFile(prefix);
  for (const char* kind : {"_lines.csv", "_lines.geojson", "_lines.svg"}) {
    std::ifstream file(prefix + kind);
    EXPECT_TRUE(file.peek() != std::ifstream::traits_type::eof()) << kind;
  }
}

}  // namespace
}  // namespace cca
