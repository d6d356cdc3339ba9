// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "io/files/atomic_file.hpp"
#include "io/lines/line_formats.hpp"
#include "io/maps/map_folder.hpp"
#include "io/maps/map_picture.hpp"
#include "io/maps/map_scene.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

MapLine line(std::uint64_t id, double x1, double y1, double x2, double y2) {
  MapLine line;
  line.id = id;
  line.segment.start = {x1, y1};
  line.segment.end = {x2, y2};
  line.segment.covariance << 1e-4, 0.0, 0.0, 1e-6;
  line.support = 10.0 * static_cast<double>(id);
  return line;
}

/// A right angle as one poly-line, and a wall apart.
MapProducts corner() {
  MapProducts products;
  products.title = "corner";
  products.lines = {line(1, 0, 0, 4, 0), line(2, 4, 0, 4, 3), line(7, -2, 5, 2, 5)};
  products.poly_lines = {{{{0, 0}, {4, 0}, {4, 3}}, {1, 2}}};
  products.trajectory = {{1, 1, 0}, {2, 1, 0.5}, {2, 2, 1.0}};
  return products;
}

/// A pillar, and a quarter of a circle.
std::vector<MapArc> pillarAndBend() {
  MapArc pillar, bend;
  pillar.arc = {{1.0, 2.0}, 0.5, 0.0, 2.0 * M_PI, 40.0, 1e-4 * Eigen::Matrix3d::Identity()};
  pillar.line_ids = {3, 4, 5};
  bend.arc = {{-1.0, 0.0}, 2.0, 0.0, 0.5 * M_PI, 60.0, 4e-4 * Eigen::Matrix3d::Identity()};
  bend.line_ids = {8, 9};
  return {pillar, bend};
}

/// A wall at x = 3 seen by a laser at the origin.
Scan wallAhead() {
  Scan scan;
  scan.angle_min = -0.5;
  scan.angle_increment = 0.01;
  for (int beam = 0; beam <= 100; ++beam) {
    scan.ranges.push_back(3.0 / std::cos(scan.bearing(static_cast<std::size_t>(beam))));
  }
  return scan;
}

/// Two kilometres of floor, known to the left of the middle and to the right of it from below only.
TEST(MapPicture, ShowsAMapOfMoreCellsThanAnImageHolds) {
  MapProducts products = corner();
  OccupancyRaster grid;
  grid.columns = 40000;
  grid.rows = 40;
  grid.resolution = 0.05;
  grid.origin = {-1000.0, -1.0};
  grid.values.assign(40000 * 40, Occupancy::kUnknown);
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < (row < 20 ? 40000 : 20000); ++column)
      grid.values[static_cast<std::size_t>(row * 40000 + column)] = Occupancy::kFree;
  }
  products.grid = grid;
  PictureOptions options;
  options.view = Eigen::AlignedBox2d(Eigen::Vector2d(-1000, -1), Eigen::Vector2d(1000, 1));
  options.caption = options.trajectory = false;
  options.longest_side = kLargestPicture;
  const TemporaryFolder folder;
  writePicture(folder / "map.png", products, options);
  const mrpt::img::CImage picture = mrpt::img::CImage::LoadFromFile(folder / "map.png");
  ASSERT_EQ(picture.getWidth(), static_cast<std::size_t>(kLargestPicture));
  const auto brightness = [&](unsigned column, unsigned row) {
    return picture.at<std::uint8_t>(column, row, 0);
  };
  const auto rows = static_cast<unsigned>(picture.getHeight());
  ASSERT_GT(rows, 12U);
  const int free = brightness(7000, rows - 3), unknown = brightness(12000, 2);
  EXPECT_GT(free, unknown + 10);
  EXPECT_NEAR(brightness(7000, 2), free, 2);
  EXPECT_NEAR(brightness(12000, rows - 3), free, 2);
}

TEST(LinesCsv, ReadsBackWhatItWrote) {
  auto lines = corner().lines;
  lines[1].segment.covariance << 4e-4, 5e-6, 5e-6, 1e-6;
  const auto back = readLinesCsv(linesCsv(lines), "lines.csv");
  ASSERT_EQ(back.size(), lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    EXPECT_EQ(back[k].id, lines[k].id);
    EXPECT_EQ(back[k].support, lines[k].support);
    EXPECT_LT((back[k].segment.start - lines[k].segment.start).norm(), 1e-4);
    EXPECT_LT((back[k].segment.end - lines[k].segment.end).norm(), 1e-4);
    const Eigen::Matrix2d &c = lines[k].segment.covariance, &d = back[k].segment.covariance;
    EXPECT_NEAR(d(0, 0), c(0, 0), 1e-3 * c(0, 0));
    EXPECT_NEAR(d(0, 1), c(0, 1), 1e-8);
    EXPECT_NEAR(d(1, 1), c(1, 1), 1e-3 * c(1, 1));
  }
}

TEST(LinesCsv, NamesFileRowAndColumnOfWhatIsWrong) {
  const auto message = [](const std::string& text) {
    try {
      readLinesCsv(text, "some.csv");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("a,b\n1,2\n"), HasSubstr("some.csv: not a line map: no column x1"));
  EXPECT_THAT(message("x1,y1,x2,y2\n1,2,3\n"), HasSubstr("row 2, column y2: missing"));
  EXPECT_THAT(message("x1,y1,x2,y2\n1,2,3,4\n1,nan,3,4\n"), HasSubstr("row 3, column y1"));
  EXPECT_THAT(message("x1,y1,x2,y2\n1,2,3,4m\n"), HasSubstr("'4m' must be a number"));
  EXPECT_THAT(message("x1,y1,x2,y2\n1,2,3,1e17\n"), HasSubstr("'1e17' must be a number in"));
}

TEST(LoneLines, AreThoseOfNoPolyLine) {
  const auto products = corner();
  const auto lone = loneLines(products.lines, products.poly_lines);
  ASSERT_EQ(lone.size(), 1U);
  EXPECT_EQ(lone[0].id, 7U);
}

TEST(GeoJson, HoldsLinesAndPolyLinesWithTheirProperties) {
  const auto products = corner();
  const auto json = nlohmann::json::parse(linesGeoJson(products.lines, products.poly_lines));
  EXPECT_EQ(json["type"], "FeatureCollection");
  ASSERT_EQ(json["features"].size(), 4U);
  const auto& first = json["features"][0];
  EXPECT_EQ(first["properties"]["kind"], "line");
  EXPECT_EQ(first["properties"]["id"], 1);
  EXPECT_EQ(first["properties"]["length"], 4.0);
  EXPECT_EQ(first["properties"]["covariance"][0], 1e-4);
  EXPECT_EQ(first["geometry"]["coordinates"][1][0], 4.0);
  const auto& chain = json["features"][3];
  EXPECT_EQ(chain["properties"]["kind"], "poly_line");
  EXPECT_EQ(chain["properties"]["length"], 7.0);
  EXPECT_EQ(chain["geometry"]["coordinates"].size(), 3U);
}

TEST(DottedWalls, AreToldApartInEachFormatOfLines) {
  auto products = corner();
  products.lines.back().kind = LineKind::kDotted;  // line 7, of no chain
  const auto json = nlohmann::json::parse(linesGeoJson(products.lines, products.poly_lines));
  EXPECT_EQ(json["features"][0]["properties"]["line_kind"], "wall");
  EXPECT_EQ(json["features"][2]["properties"]["line_kind"], "dotted");
  EXPECT_EQ(readLinesCsv(linesCsv(products.lines), "a").back().kind, LineKind::kDotted);
  const auto times = [](const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
      ++count;
    }
    return count;
  };
  const std::string svg = linesSvg(products.lines, products.poly_lines, {});
  EXPECT_EQ(times(svg, "data-id=\"7\" data-support=\"70.0\" stroke-dasharray="), 1);
  EXPECT_EQ(times(svg, "stroke-dasharray="), 1);
  const std::string dxf = linesDxf(products.lines, products.poly_lines, {});
  EXPECT_EQ(times(dxf, "8\nDOTTED\n100\nAcDbLine"), 1);
  EXPECT_EQ(times(dxf, "8\nLINES\n100\nAcDbLine"), 3);
}

TEST(Arcs, AreRowsOfCentreRadiusAndExtent) {
  EXPECT_EQ(arcsCsv(pillarAndBend()),
            "x,y,radius,start_deg,sweep_deg,sigma_x,sigma_y,sigma_radius,line_ids\n"
            "1.0000,2.0000,0.5000,0.000,360.000,0.010000,0.010000,0.010000,3 4 5\n"
            "-1.0000,0.0000,2.0000,0.000,90.000,0.020000,0.020000,0.020000,8 9\n");
}

TEST(Arcs, AreCirclesAndArcsOfTheirOwnInDxfAndSvg) {
  const std::string dxf = linesDxf({}, {}, {}, pillarAndBend());
  EXPECT_THAT(dxf, HasSubstr("8\nARCS\n100\nAcDbCircle\n10\n1.0000\n20\n2.0000\n30\n0.0000\n"
                             "40\n0.5000\n0\nARC\n"));
  EXPECT_THAT(dxf, HasSubstr("40\n2.0000\n100\nAcDbArc\n50\n0.0000\n51\n90.0000\n"));
  const std::string svg = linesSvg({}, {}, {}, pillarAndBend());
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"1.0000\" cy=\"-2.0000\" r=\"0.5000\"/>"));
  EXPECT_THAT(svg, HasSubstr("M 1.0000 -0.0000 A 2.0000 2.0000 0 0 0 -1.0000 -2.0000"));
}

TEST(Arcs, AreFeaturesOfTheGeoJsonThatReadersOfLinesPassOver) {
  const auto products = corner();
  const std::string text =
      linesGeoJson(products.lines, products.poly_lines, products.trajectory, pillarAndBend());
  const auto json = nlohmann::json::parse(text);
  ASSERT_EQ(json["features"].size(), 7U);
  const auto& bend = json["features"][5];
  EXPECT_EQ(bend["properties"]["kind"], "arc");
  EXPECT_EQ(bend["properties"]["radius"], 2.0);
  EXPECT_EQ(bend["properties"]["sweep_deg"], 90.0);
  EXPECT_EQ(bend["geometry"]["coordinates"].size(), 19U);  // 5 degrees apart
  EXPECT_EQ(readLinesGeoJson(text, "lines.geojson").poly_lines.size(), 1U);
}

TEST(GeoJson, ReadsBackChainsAndTrajectory) {
  const auto products = corner();
  const auto back = readLinesGeoJson(
      linesGeoJson(products.lines, products.poly_lines, products.trajectory), "lines.geojson");
  ASSERT_EQ(back.poly_lines.size(), 1U);
  EXPECT_EQ(back.poly_lines[0].line_ids, products.poly_lines[0].line_ids);
  EXPECT_EQ(back.poly_lines[0].vertices, products.poly_lines[0].vertices);
  ASSERT_EQ(back.trajectory.size(), 3U);
  EXPECT_NEAR(back.trajectory[2].theta, 0.5 * M_PI, 1e-9);  // it went along y
  EXPECT_THROW(readLinesGeoJson("{}", "a"), std::runtime_error);
  EXPECT_THROW(readLinesGeoJson("no JSON", "a"), std::runtime_error);
}

TEST(GeoJson, EmptyMapIsValid) {
  EXPECT_TRUE(nlohmann::json::parse(linesGeoJson({}, {}))["features"].empty());
}

TEST(Svg, IsToScale) {
  // x from -2 to 4, y from 0 to 5, half a metre of margin, .9 m for the scale: 7 m x 6.9 m at 1 :
  // 100.
  const auto products = corner();
  const std::string svg = linesSvg(products.lines, products.poly_lines, products.trajectory);
  EXPECT_THAT(svg, HasSubstr("width=\"70.00mm\" height=\"69.00mm\""));
  EXPECT_THAT(svg, HasSubstr("points=\"0.0000,-0.0000 4.0000,-0.0000 4.0000,-3.0000 \""));
}

TEST(Svg, HasAScaleBarAndNorthWhereItIsTold) {
  const auto products = corner();
  const std::string plain = linesSvg(products.lines, products.poly_lines, products.trajectory);
  EXPECT_THAT(plain, HasSubstr("h 1 v -0.16"));  // a quarter of 6 m at the most
  EXPECT_THAT(plain, HasSubstr(">1 m</text>"));
  EXPECT_THAT(plain, Not(HasSubstr("id=\"north\"")));
  const std::string placed = linesSvg(products.lines, products.poly_lines, products.trajectory, {},
                                      GeoReference{48.0, 11.0, 30.0});
  EXPECT_THAT(placed, HasSubstr("rotate(30.0000)"));
}

TEST(Dxf, TellsItsUnitAndHasAllWallsOnBothLayers) {
  const auto products = corner();
  const std::string dxf = linesDxf(products.lines, products.poly_lines, {});
  EXPECT_THAT(dxf, HasSubstr("$ACADVER\n1\nAC1015\n"));
  EXPECT_THAT(dxf, HasSubstr("$INSUNITS\n70\n6\n"));  // metres
  std::size_t lines = 0, chains = 0;
  for (std::size_t at = 0; (at = dxf.find("8\nLINES\n", at)) != std::string::npos; ++at) ++lines;
  for (std::size_t at = 0; (at = dxf.find("LWPOLYLINE\n", at)) != std::string::npos; ++at) ++chains;
  EXPECT_EQ(lines, products.lines.size());
  EXPECT_EQ(chains, products.poly_lines.size());
}

TEST(GeoReference, MetresAndDegreesLeadToEachOther) {
  const GeoReference place{48.1, 11.6, 30.0};
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), {300, -500}, {-700, 200}}) {
    EXPECT_LT((place.toMap(place.toDegrees(p)) - p).norm(), 1e-4);
  }
}

TEST(GeoReference, ADegreeOfLatitudeIsAsLongAsTheTablesSay) {
  // Length of a minute of arc of the meridian at 45 degrees on WGS 84: 1852.2 m (Bowditch, table
  // 7).
  const GeoReference place{45.0, 0.0, 0.0};
  EXPECT_NEAR(place.toMap({0.0, 45.0 + 0.5 / 60.0}).y(), 0.5 * 1852.2, 0.1);
  const GeoReference turned{45.0, 0.0, 90.0};  // x is north
  EXPECT_NEAR(turned.toMap({0.0, 45.0 + 0.5 / 60.0}).x(), 0.5 * 1852.2, 0.1);
}

TEST(GeoReference, IsReadFromTwoOrThreeNumbers) {
  EXPECT_EQ(geoReferenceOf("48.1,11.6").turn_deg, 0.0);
  EXPECT_EQ(geoReferenceOf("-48.1,11.6,-30").turn_deg, -30.0);
  for (const char* wrong :
       {"", "48", "48,11,3,4", "48;11", "91,0", "0,181", "0,0,400", "48,east"}) {
    EXPECT_THROW(geoReferenceOf(wrong), std::runtime_error) << wrong;
  }
}

TEST(GeoJson, IsInDegreesWhereTheOriginIsToldAndReadsBackInMetres) {
  const auto products = corner();
  const std::string text = linesGeoJson(products.lines, products.poly_lines, products.trajectory,
                                        {}, GeoReference{48.1, 11.6, 30.0});
  const auto json = nlohmann::json::parse(text);
  EXPECT_FALSE(json.contains("note"));
  const auto& first = json["features"][0]["geometry"]["coordinates"][0];
  EXPECT_NEAR(first[0].get<double>(), 11.6, 1e-9);
  EXPECT_NEAR(first[1].get<double>(), 48.1, 1e-9);
  const auto back = readLinesGeoJson(text, "lines.geojson");
  EXPECT_LT((back.poly_lines[0].vertices[2] - products.poly_lines[0].vertices[2]).norm(), 1e-3);
  const auto plain = nlohmann::json::parse(linesGeoJson(products.lines, products.poly_lines));
  EXPECT_EQ(plain["note"], "metres of the map frame, not longitude and latitude");
}

TEST(MapFolder, HoldsEveryFileAndNothingElse) {
  const TemporaryFolder folder;
  MapProducts products = corner();
  ScanGrid grid;
  grid.insert(wallAhead());
  products.grid = grid.raster();
  products.summary["finished"] = true;
  writeMapFolder(folder / "map", products);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "map")) {
    names.push_back(entry.path().filename().string());
    EXPECT_GT(entry.file_size(), 0U) << entry.path();
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre(
                         "lines.csv", "arcs.csv", "lines.geojson", "lines.svg", "lines.dxf",
                         "map.png", "map.pgm", "map.yaml", "map.gridmap.gz", "map.linemap.gz",
                         "scene.3Dscene", "summary.json", "plan.geojson", "plan.svg", "plan.dxf",
                         "plan.pdf", "rooms.csv", "rooms.png"));
  const auto summary = nlohmann::json::parse(bytesOf(folder / "map/summary.json"));
  EXPECT_EQ(summary["finished"], true);
  EXPECT_EQ(summary["map_lines"], 3);
  EXPECT_EQ(summary["map_length_m"], 11.0);
}

TEST(MapFolder, IsNotOverwrittenUnasked) {
  const TemporaryFolder folder;
  writeMapFolder(folder.path(), corner());
  EXPECT_THROW(static_cast<void>(prepareMapFolder(folder.path(), false)), std::runtime_error);
  EXPECT_NO_THROW(static_cast<void>(prepareMapFolder(folder.path(), true)));
}

// A world's map.pgm, or a log of somebody's own, in a folder that holds no map.
TEST(MapFolder, NoFileThatIsThereIsOverwrittenUnasked) {
  for (const char* name : {"map.pgm", "lines.csv", "run.rawlog"}) {
    const TemporaryFolder folder;
    std::ofstream(folder / name) << "mine";
    try {
      static_cast<void>(prepareMapFolder(folder.path(), false, {"run.rawlog"}));
      FAIL() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(static_cast<void>(prepareMapFolder(folder.path(), true, {"run.rawlog"})));
    EXPECT_EQ(bytesOf(folder / name), "mine");
  }
}

// Found when half of the files are written, it would leave two maps mixed.
TEST(MapFolder, AFolderThatHasTheNameOfAFileIsRefusedBeforeAll) {
  for (const char* name : {"lines.svg", "rooms.png", "run.rawlog"}) {
    const TemporaryFolder folder;
    fs::create_directory(folder / name);
    try {
      static_cast<void>(prepareMapFolder(folder.path(), true, {"run.rawlog"}));
      FAIL() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(folder / name + ": is a folder"));
    }
  }
}

TEST(MapFolder, HoldsNothingOfTheMapThatItHeldBefore) {
  const TemporaryFolder folder;
  for (const char* name : {"map.slam", "poses.tum", "graph.g2o", "poses.csv", "run.rawlog",
                           "trajectory.csv", "localisation.png"}) {
    std::ofstream(folder / name) << "earlier";
  }
  MapProducts products = corner();
  products.memory = {};
  products.times = {};
  products.beside = {"poses.csv"};
  writeMapFolder(folder.path(), products);
  for (const char* name : {"map.slam", "poses.tum", "trajectory.csv", "localisation.png"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const char* name : {"poses.csv", "run.rawlog"}) EXPECT_TRUE(fs::exists(folder / name));
}

TEST(MapFolder, AFileInItsPlaceIsNamed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  try {
    static_cast<void>(prepareMapFolder(folder / "file", true));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(folder / "file"));
  }
}

TEST(MapFolder, FailedWriteLeavesTheOldFile) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    std::ofstream(file.temporary()) << "half of the n";
  }
  EXPECT_EQ(bytesOf(folder / "a.txt"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(MapFolder, IsClearedOfWhatAKilledRunHasLeft) {
  const TemporaryFolder folder;
  const std::string mine = ".map.part-" + std::to_string(getpid()) + "-3.png";
  for (const std::string& name : {std::string(".map.part-999999999-0.png"), mine}) {
    std::ofstream(folder / name) << "half";
  }
  static_cast<void>(prepareMapFolder(folder.path(), false));
  EXPECT_FALSE(fs::exists(folder / ".map.part-999999999-0.png"));
  EXPECT_TRUE(fs::exists(folder / mine));  // its program lives
}

TEST(MapFolder, IsOneRunsAtATime) {
  const TemporaryFolder folder;
  {
    const FolderLock first = prepareMapFolder(folder.path(), true);
    EXPECT_THROW(static_cast<void>(prepareMapFolder(folder.path(), true)), std::runtime_error);
  }
  EXPECT_NO_THROW(static_cast<void>(prepareMapFolder(folder.path(), true)));
}

TEST(MapFolder, HasNoSummaryWhereItsFilesWereReplacedInPart) {
  const TemporaryFolder folder;
  writeMapFolder(folder.path(), corner());
  fs::remove(folder / "map.png");
  fs::create_directory(folder / "map.png");  // cannot be overwritten
  EXPECT_THROW(writeMapFolder(folder.path(), corner()), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
}

TEST(MapFolder, TakesNamesThatAreNotUtf8) {
  const TemporaryFolder folder;
  MapProducts products = corner();
  products.title = "caf\xE9.log";
  products.summary["log"] = products.title;
  writeMapFolder(folder.path(), products);
  EXPECT_TRUE(nlohmann::json::accept(bytesOf(folder / "summary.json")));
}

TEST(AtomicFile, WritesWhatALinkLeadsTo) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "old");
  fs::create_symlink("a.txt", folder / "link.txt");
  writeFile(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(bytesOf(folder / "a.txt"), "new");
}

TEST(AtomicFile, TakesTheNameOfNoDeviceAndNoFolder) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder / "null");
  EXPECT_THROW(AtomicFile(folder / "null"), std::runtime_error);
  EXPECT_NO_THROW(writeFile(folder / "null", "into the void"));
  EXPECT_TRUE(fs::is_character_file(folder / "null"));
  EXPECT_THROW(writeFile(folder.path(), "x"), std::runtime_error);
}

TEST(MapFolder, EmptyMapIsWrittenToo) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(writeMapFolder(folder.path(), {}));
  EXPECT_TRUE(fs::exists(folder / "map.png"));
}

TEST(OccupancyMap, MrptReadsBackTheSamePlaces) {
  const TemporaryFolder folder;
  MapProducts products = corner();
  ScanGrid grid;
  for (int times = 0; times < 10; ++times) grid.insert(wallAhead());
  products.grid = grid.raster();
  writeMapFolder(folder.path(), products);
  mrpt::maps::COccupancyGridMap2D back;
  ASSERT_TRUE(back.loadFromROSMapServerYAML(folder / "map.yaml"));
  EXPECT_NEAR(back.getResolution(), 0.05, 1e-6);
  EXPECT_LT(back.getPos(3.02F, 0.02F), 0.2F);       // the wall
  EXPECT_GT(back.getPos(1.5F, 0.02F), 0.8F);        // on the way to it
  EXPECT_NEAR(back.getPos(3.5F, 0.02F), 0.5, 0.3);  // behind it
}

TEST(ScanGrid, BeamsWithoutReturnFreeOnlyWhatTheScanPromises) {
  Scan scan = wallAhead();
  scan.ranges.assign(scan.ranges.size(), HUGE_VAL);
  ScanGrid silent, promising;
  silent.insert(scan);
  scan.free_range_without_return = 4.0;
  for (int times = 0; times < 10; ++times) promising.insert(scan);
  EXPECT_NEAR(silent.grid()->getPos(2.0F, 0.02F), 0.5, 0.02);
  EXPECT_GT(promising.grid()->getPos(3.8F, 0.02F), 0.8F);
  EXPECT_NEAR(promising.grid()->getPos(4.3F, 0.02F), 0.5, 0.02);
}

TEST(ScanGrid, BrokenPoseDoesNotExhaustTheMemory) {
  ScanGrid grid;
  Scan scan = wallAhead();
  scan.T_map_sensor.x = 1e7;
  grid.insert(scan);
  EXPECT_LT(grid.grid()->getSizeX(), 1000U);
}

TEST(Picture, ShowsTheWallsWhereTheyAre) {
  const TemporaryFolder folder;
  PictureOptions options;
  options.longest_side = 400;
  options.caption = options.trajectory = false;
  options.view = Eigen::AlignedBox2d(Eigen::Vector2d(-4, -4), Eigen::Vector2d(6, 6));
  writePicture(folder / "a.png", corner(), options);
  mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile(folder / "a.png"));
  ASSERT_EQ(image.getWidth(), 400U);
  ASSERT_EQ(image.getHeight(), 400U);
  const auto brightness = [&](double x, double y) {
    const auto* bgr = image.ptr<std::uint8_t>(static_cast<unsigned>(40.0 * (x + 4.0)),
                                              static_cast<unsigned>(40.0 * (6.0 - y)));
    return (bgr[0] + bgr[1] + bgr[2]) / 3;
  };
  EXPECT_LT(brightness(2.0, 0.0), 150);  // the poly-line's first wall
  EXPECT_LT(brightness(0.0, 5.0), 150);  // the single wall
  EXPECT_GT(brightness(2.0, 2.5), 200);  // nothing
}

TEST(Picture, TintsRoomsUnderTheLinesAndNotTheirHoles) {
  const TemporaryFolder folder;
  PictureOptions options;
  options.longest_side = 400;
  options.caption = options.trajectory = false;
  options.view = Eigen::AlignedBox2d(Eigen::Vector2d(-4, -4), Eigen::Vector2d(6, 6));
  options.rooms.resize(1);
  options.rooms[0].outline = {{0, 0}, {4, 0}, {4, 5}, {0, 5}};
  options.rooms[0].holes = {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  writePicture(folder / "rooms.png", corner(), options);
  options.rooms.clear();
  writePicture(folder / "none.png", corner(), options);
  const auto colourAt = [&](const char* name, double x, double y) {
    mrpt::img::CImage image;
    if (!image.loadFromFile(folder / name)) ADD_FAILURE() << name;
    const auto* bgr = image.ptr<std::uint8_t>(static_cast<unsigned>(40.0 * (x + 4.0)),
                                              static_cast<unsigned>(40.0 * (6.0 - y)));
    return std::array<int, 3>{bgr[0], bgr[1], bgr[2]};
  };
  EXPECT_NE(colourAt("rooms.png", 3, 3.5), colourAt("none.png", 3, 3.5));
  for (int k : {0, 1, 2}) {  // lightly
    EXPECT_NEAR(colourAt("rooms.png", 3, 3.5)[static_cast<std::size_t>(k)],
                colourAt("none.png", 3, 3.5)[static_cast<std::size_t>(k)], 26);
  }
  EXPECT_EQ(colourAt("rooms.png", 1.5, 1.5), colourAt("none.png", 1.5, 1.5));  // a hole
  EXPECT_EQ(colourAt("rooms.png", 5, 3), colourAt("none.png", 5, 3));          // outside
  EXPECT_EQ(colourAt("rooms.png", 2.0, 0.0), colourAt("none.png", 2.0, 0.0));  // a wall lies above
}

TEST(WholeView, ShowsAllLinesAndPoses) {
  MapProducts products = corner();
  products.lines.push_back(line(8, 150, 0, 150, 1));  // no pose near it, but no wide gap either
  products.trajectory.push_back({-90, 0, 0});
  const auto view = wholeView(products);
  for (const MapLine& l : products.lines) {
    EXPECT_TRUE(view.contains(l.segment.start) && view.contains(l.segment.end));
  }
  for (const Pose2& pose : products.trajectory) EXPECT_TRUE(view.contains(pose.position()));
  EXPECT_NEAR(view.sizes().x(), 242.0, 1e-9);
}

TEST(WholeView, LeavesOutAPoseThatHasGoneAstrayAndWhatWasSeenFromIt) {
  MapProducts products = corner();
  for (int k = 0; k < 40; ++k) products.trajectory.push_back({0.05 * k, 1.0, 0.0});
  const auto ordinary = wholeView(products);
  products.trajectory.insert(products.trajectory.begin() + 20, Pose2{3.0, 1e4, 0.0});
  products.lines.push_back(line(9, 0, 1.001e4, 9, 1.001e4));
  products.trajectory.insert(products.trajectory.begin() + 10, Pose2{-1e4, 2.0, 0.0});
  EXPECT_TRUE(wholeView(products).isApprox(ordinary));
  products.trajectory.clear();
  products.lines = {line(1, 0, 0, 90, 0), line(2, 0, 0, 0, 90), line(3, 5000, 0, 5001, 0)};
  EXPECT_NEAR(wholeView(products).sizes().x(), 92.0, 1e-9);
}

TEST(WholeView, ShowsBothOfTwoPlacesFarApart) {
  MapProducts products = corner();
  products.lines.push_back(line(8, 5000, 0, 5009, 0));
  EXPECT_TRUE(wholeView(products).contains(Eigen::Vector2d(0, 0)));
  products.trajectory.push_back({5001, 1, 0});
  EXPECT_TRUE(wholeView(products).contains(Eigen::Vector2d(5009, 0)));
}

TEST(Picture, GrowsWithItsSize) {
  const TemporaryFolder folder;
  PictureOptions options;
  options.longest_side = 2000;
  writePicture(folder / "a.png", corner(), options);
  mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile(folder / "a.png"));
  EXPECT_EQ(image.getWidth(), 2000U);
}

TEST(Scene, LoadsBackWithItsObjects) {
  const TemporaryFolder folder;
  writeScene(folder / "a.3Dscene", corner());
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder / "a.3Dscene"));
  for (const char* name : {"walls", "lines", "trajectory", "start", "end"}) {
    EXPECT_TRUE(scene.getByName(name)) << name;
  }
}

}  // namespace
}  // namespace cca
