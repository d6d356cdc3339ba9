// SPDX-License-Identifier: BSD-3-Clause
#include "io/plans/plan_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "io/files/atomic_file.hpp"
#include "io/lines/line_formats.hpp"
#include "io/plans/plan_formats.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

using testing::HasSubstr;

PlanFile readAs(const std::string& name, const std::string& text, double scale = 0.0) {
  const TemporaryFolder folder;
  writeFile(folder / name, text);
  return readPlan(folder / name, scale);
}

std::string whyNot(const std::string& name, const std::string& text) {
  try {
    readAs(name, text);
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(name));
    return error.what();
  }
  return "it was read";
}

/// Whether the plan has this line, in either direction.
bool holds(const PlanFile& plan, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::any_of(plan.lines.begin(), plan.lines.end(), [&](const PlanLine& line) {
    const auto is = [&](const auto& p, const auto& q) {
      return (line.first - p).norm() < 1e-6 && (line.second - q).norm() < 1e-6;
    };
    return is(a, b) || is(b, a);
  });
}

std::string dxf(const std::string& entities, const std::string& before = "") {
  return before + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}
const std::string kLine = "0\nLINE\n8\nWALLS\n10\n1.0\n20\n2.0\n11\n4.0\n21\n6.0\n";

TEST(PlanReader, ReadsTheLinesOfACsvOfAnybody) {
  const PlanFile plan = readAs("a.csv", "x1,y1,x2,y2\n0,0,3,0\n3,0,3,2\n");
  ASSERT_EQ(plan.lines.size(), 2U);
  EXPECT_TRUE(holds(plan, {3, 0}, {3, 2}));
}

TEST(PlanReader, ReadsLinesAndPolylinesOfADxf) {
  const PlanFile plan =
      readAs("a.dxf",
             dxf(kLine +
                 "0\nLWPOLYLINE\n8\nWALLS\n90\n3\n70\n1\n10\n0\n20\n0\n10\n5\n20\n0\n10\n5\n20\n4\n"
                 "0\nPOLYLINE\n8\nWALLS\n70\n0\n0\nVERTEX\n10\n7\n20\n7\n0\nVERTEX\n10\n8\n20\n7\n"
                 "0\nSEQEND\n0\nTEXT\n8\nWALLS\n1\nkitchen\n"));
  EXPECT_EQ(plan.lines.size(), 5U);
  EXPECT_TRUE(holds(plan, {1, 2}, {4, 6}));
  EXPECT_TRUE(holds(plan, {5, 4}, {0, 0}));  // it is closed
  EXPECT_TRUE(holds(plan, {7, 7}, {8, 7}));
  EXPECT_EQ(plan.not_understood, "1 TEXT");
}

TEST(PlanReader, HeedsTheUnitsOfADxfAndAScaleThatIsGivenMore) {
  const std::string millimetres = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
  EXPECT_TRUE(holds(readAs("a.dxf", dxf(kLine, millimetres)), {.001, .002}, {.004, .006}));
  const TemporaryFolder folder;
  writeFile(folder / "a.dxf", dxf(kLine, millimetres));
  EXPECT_TRUE(holds(readPlan(folder / "a.dxf", 0.5), {0.5, 1.0}, {2.0, 3.0}));
}

TEST(PlanReader, LeavesOutLayersThatAreOffAndThoseOfDoors) {
  const std::string layers =
      "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nHIDDEN\n70\n0\n62\n-7\n0\nENDTAB\n"
      "0\nENDSEC\n";
  const auto on = [](const std::string& layer) {
    return "0\nLINE\n8\n" + layer + "\n10\n0\n20\n0\n11\n9\n21\n9\n";
  };
  const PlanFile plan = readAs("a.dxf", dxf(kLine + on("HIDDEN") + on("A-DOOR-SWNG"), layers));
  EXPECT_EQ(plan.lines.size(), 1U);
}

TEST(PlanReader, AnArcOfADxfIsItsChords) {
  const PlanFile plan =
      readAs("a.dxf", dxf("0\nARC\n8\nW\n10\n0\n20\n0\n40\n2.0\n50\n270\n51\n90\n"));
  ASSERT_GT(plan.lines.size(), 5U);
  EXPECT_LT((plan.lines.front().first - Eigen::Vector2d(0, -2)).norm(), 1e-9);
  EXPECT_LT((plan.lines.back().second - Eigen::Vector2d(0, 2)).norm(), 1e-9);
  for (const auto& [a, b] : plan.lines) EXPECT_GT((0.5 * (a + b)).norm(), 1.989);
}

TEST(PlanReader, SaysWhatIsWrongWithADxf) {
  EXPECT_THAT(whyNot("a.dxf", "AutoCAD Binary DXF\r\n"), HasSubstr("save it as ASCII"));
  EXPECT_THAT(whyNot("a.dxf", "hello\nworld\n"), HasSubstr("line 2: 'hello' is no group code"));
  EXPECT_THAT(whyNot("a.dxf", dxf("0\nLINE\n10\nwide\n")), HasSubstr("'wide' of group 10"));
  EXPECT_THAT(whyNot("a.dxf", dxf("0\nTEXT\n1\nx\n")), HasSubstr("holds no line, but 1 TEXT"));
}

TEST(PlanReader, ReadsGeometriesOfGeoJson) {
  const PlanFile plan = readAs("a.geojson",
                               R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": null, "geometry":
          {"type": "MultiLineString", "coordinates": [[[0, 0], [1, 0]], [[5, 5], [6, 5], [6, 7]]]}},
        {"type": "Feature", "properties": {}, "geometry":
          {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 0]]]}},
        {"type": "Feature", "properties": {"kind": "trajectory"}, "geometry":
          {"type": "LineString", "coordinates": [[9, 9], [8, 8]]}},
        {"type": "Feature", "properties": {"thickness_m": 0.2}, "geometry":
          {"type": "LineString", "coordinates": [[0, 10], [4, 10]]}},
        {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [1, 1]}}
      ]})");
  EXPECT_EQ(plan.lines.size(), 8U);
  EXPECT_TRUE(holds(plan, {6, 5}, {6, 7}));
  EXPECT_TRUE(holds(plan, {2, 2}, {0, 0}));
  EXPECT_TRUE(holds(plan, {0, 10.1}, {4, 10.1}));
  EXPECT_TRUE(holds(plan, {0, 9.9}, {4, 9.9}));
  EXPECT_EQ(plan.not_understood, "1 Point");
}

TEST(PlanReader, SaysThatGeoJsonIsNone) {
  EXPECT_THAT(whyNot("a.geojson", "{"), HasSubstr("is no GeoJSON"));
  EXPECT_THAT(whyNot("a.json", R"({"type": "LineString", "coordinates": [[0, "x"], [1, 1]]})"),
              HasSubstr("is no GeoJSON"));
}

TEST(PlanReader, ReadsTheShapesOfAnSvgByTheTransformsOfItsGroups) {
  const PlanFile plan = readAs("a.svg", R"svg(<?xml version="1.0"?>
    <!-- <line x1="9" y1="9" x2="8" y2="8"/> -->
    <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">
    <defs><line x1="9" y1="9" x2="8" y2="8"/></defs>
    <g transform="translate(1 2) scale(2)"><line x1="0" y1="0" x2="1" y2="0"/></g>
    <line transform="rotate(90)" x1="1" y1="0" x2="2" y2="0"/>
    <polygon points="0,0 3,0 3,3"/>
    <path d="M10 0h2v1H10zm0 5 l1,0 1 0"/>
    <g id="furniture"><path d="M20 0h1"/></g>
    <text x="1" y="1">a &gt; b</text>
    </svg>)svg");
  EXPECT_EQ(plan.lines.size(), 12U);
  EXPECT_TRUE(holds(plan, {1, -2}, {3, -2}));
  EXPECT_TRUE(holds(plan, {0, -1}, {0, -2}));
  EXPECT_TRUE(holds(plan, {3, -3}, {0, 0}));
  EXPECT_TRUE(holds(plan, {10, -1}, {10, 0}));
  EXPECT_TRUE(holds(plan, {11, -5}, {12, -5}));
  EXPECT_EQ(plan.not_understood, "1 <text>");
}

TEST(PlanReader, SaysWhatIsWrongWithAnSvg) {
  EXPECT_THAT(whyNot("a.svg", "<html></html>"), HasSubstr("it has no <svg>"));
  EXPECT_THAT(whyNot("a.svg", "<svg><line x1='far'/></svg>"), HasSubstr("x1=\"far\""));
  EXPECT_THAT(whyNot("a.svg", "<svg><polyline points='1 2 3'/></svg>"), HasSubstr("odd number"));
  EXPECT_THAT(whyNot("a.svg", "<svg><g transform='skewX(3)'></g></svg>"), HasSubstr("skewX"));
  EXPECT_THAT(whyNot("a.svg", "<svg><line x1='0'"), HasSubstr("ends within a tag"));
  EXPECT_THAT(whyNot("a.svg", "<svg id='cca_mrpt_plan'></svg>"), HasSubstr("data-to-metres"));
  EXPECT_THAT(readAs("a.svg", "<svg><path d='M0 0 L1 0 C 1 1 2 2 3 3'/></svg>").not_understood,
              HasSubstr("1 paths with C"));
}

/// A wall of two faces, one of one face, a presumed one; a room, a door and a table, far from (0,
/// 0).
FloorPlan smallPlan() {
  const Eigen::Vector2d p(4321.0, -98765.0);
  FloorPlan plan;
  plan.walls.resize(3);
  plan.walls[0] = {1, p, p + Eigen::Vector2d(8, 0), 0.2, {}, {}, false};
  plan.walls[1] = {2, p + Eigen::Vector2d(8, 0), p + Eigen::Vector2d(8, 5), 0.0, {}, {}, false};
  plan.walls[2] = {3, p + Eigen::Vector2d(0, 5), p + Eigen::Vector2d(1, 4), 0.0, {}, {}, true};
  PlanRoom room;
  room.id = 1;
  room.outline = {p, p + Eigen::Vector2d(8, 0), p + Eigen::Vector2d(8, 5),
                  p + Eigen::Vector2d(0, 5)};
  room.area = 40.0;
  room.label = p + Eigen::Vector2d(4, 2);
  plan.rooms = {room};
  PlanOpening door;
  door.a = p + Eigen::Vector2d(0, 1);
  door.b = p + Eigen::Vector2d(0, 2);
  plan.openings = {door};
  PlanFurniture table;
  table.outline = {p + Eigen::Vector2d(2, 2), p + Eigen::Vector2d(3, 2), p + Eigen::Vector2d(3, 3)};
  plan.furniture = {table};
  return plan;
}

TEST(PlanReader, OurOwnSheetGivesTheLinesOfOurOwnDrawingInTheMapsFrame) {
  const FloorPlan plan = smallPlan();
  const PlanFile sheet = readAs("plan.svg", planSvg(plan, "walls", GeoReference{52.5, 13.4, 20.0}));
  const PlanFile drawing = readAs("plan.dxf", planDxf(plan));
  ASSERT_EQ(sheet.lines.size(), 9U);
  ASSERT_EQ(drawing.lines.size(), 9U);
  EXPECT_EQ(sheet.not_understood, "");
  for (const PlanLine& line : drawing.lines) {
    EXPECT_TRUE(std::any_of(sheet.lines.begin(), sheet.lines.end(), [&](const PlanLine& drawn) {
      return (drawn.first - line.first).norm() < 2e-4 && (drawn.second - line.second).norm() < 2e-4;
    })) << line.first.transpose();
  }
}

TEST(PlanReader, AScaleIsHeededOrRefused) {
  const TemporaryFolder folder;
  writeFile(folder / "lines.csv", "x1,y1,x2,y2,sigma_offset,sigma_angle_deg\n0,0,300,100,2,1\n");
  for (const std::string& path : {folder.path(), folder / "lines.csv"}) {
    const PlanFile plan = readPlan(path, 0.01);
    EXPECT_TRUE(holds(plan, {0, 0}, {3, 1}));
    EXPECT_NEAR(plan.sigmas.at(0).offset, 0.02, 1e-12);
  }
  EXPECT_TRUE(
      holds(readAs("a.svg", "<svg><line x2='200' y2='-100'/></svg>", 0.01), {0, 0}, {2, 1}));
  const std::string line = R"({"type": "LineString", "coordinates": [[0, 0], [200, 100]])";
  EXPECT_TRUE(holds(readAs("a.json", line + "}", 0.01), {0, 0}, {2, 1}));
  const std::pair<const char*, std::string> refused[] = {
      {"a.slam", ""}, {"a.yaml", ""}, {"a.json", line + R"(, "origin": [52.5, 13.4, 0]})"}};
  for (const auto& [name, text] : refused) {
    try {
      readAs(name, text, 0.01);
      ADD_FAILURE() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(name), HasSubstr("a scale is for"))) << name;
    }
  }
}

TEST(PlanReader, SaysHowMuchAPlanIs) {
  EXPECT_EQ(sizeInWords({{{0, 0}, {3, 1}}, {{-1, 2}, {0, 0}}}), "2 lines within 4.0 x 2.0 m");
}

TEST(PlanReader, TellsWhichEndingsItKnows) {
  EXPECT_THAT(whyNot("a.pdf", "%PDF"), HasSubstr("allowed are"));
  EXPECT_THROW(readPlan("/nowhere/a.dxf"), std::runtime_error);
}

TEST(PlanReader, RefusesNumbersThatAreFarFromAnyBuilding) {
  EXPECT_THAT(whyNot("a.csv", "x1,y1,x2,y2\n0,0,1e12,0\n"), HasSubstr("[-1e8, 1e8] m"));
  EXPECT_THAT(whyNot("a.svg", "<svg><line x1='1e12'/></svg>"), HasSubstr("1e8 m"));
  EXPECT_THAT(
      whyNot("a.csv", "x1,y1,x2,y2\n0,0,1,0\n4e5,5.8e6,4e5,5.9e6\n"),
      AllOf(HasSubstr("between (0, 0) and (400000, 5.9e+06) m"), HasSubstr("1000 m apart")));
}

MapLine lineOf(std::uint64_t id, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  MapLine line;
  line.id = id;
  line.segment.start = a;
  line.segment.end = b;
  return line;
}

TEST(PlanReader, EachOfOurOwnFormatsGivesTheSameLines) {
  const std::vector<MapLine> lines{lineOf(1, {0, 0}, {5, 0}), lineOf(2, {5, 0}, {5, 3}),
                                   lineOf(3, {1, 1}, {2, 2})};
  const std::vector<PolyLine> chains{{{{0, 0}, {5, 0}, {5, 3}}, {1, 2}}};
  const std::vector<Pose2> way{{1, 1, 0}, {2, 1, 0}, {3, 1, 0}};
  const GeoReference place{52.5, 13.4, 20.0};
  const std::pair<const char*, std::string> files[] = {
      {"lines.csv", linesCsv(lines)},
      {"lines.geojson", linesGeoJson(lines, chains, way)},
      {"lines.svg", linesSvg(lines, chains, way)},
      {"lines.dxf", linesDxf(lines, chains, way)}};
  for (const auto& [name, text] : files) {
    const PlanFile plan = readAs(name, text);
    EXPECT_TRUE(holds(plan, {0, 0}, {5, 0})) << name;
    EXPECT_TRUE(holds(plan, {5, 0}, {5, 3})) << name;
    EXPECT_TRUE(holds(plan, {1, 1}, {2, 2})) << name;
    EXPECT_EQ(plan.lines.size(), 3U) << name;
  }
  const PlanFile on_earth = readAs("lines.geojson", linesGeoJson(lines, chains, way, {}, place));
  ASSERT_EQ(on_earth.lines.size(), 3U);
  EXPECT_LT((on_earth.lines[1].second - Eigen::Vector2d(5, 3)).norm(), 0.01);
}

/// A grid of 5 cm, of 10 x 8 m: 0 occupied, 205 unknown, 254 free, as `cell` says at its middle,
/// unless `meaning` says otherwise.
PlanFile readGrid(const std::function<int(const Eigen::Vector2d&)>& cell,
                  const std::string& meaning =
                      "negate: 0\noccupied_thresh: 0.65\n"
                      "free_thresh: 0.196\n") {
  const TemporaryFolder folder;
  std::string image = "P5\n200 160\n255\n";
  for (int row = 159; row >= 0; --row) {
    for (int column = 0; column < 200; ++column) {
      image += static_cast<char>(cell(0.05 * Eigen::Vector2d(column + 0.5, row + 0.5)));
    }
  }
  writeFile(folder / "a.pgm", image);
  writeFile(folder / "a.yaml",
            "image: a.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\n" + meaning);
  return readPlan(folder / "a.yaml");
}

TEST(PlanReader, TheWallsOfAGridAreItsFacesTowardsFreeSpace) {
  const PlanFile plan = readGrid([](const Eigen::Vector2d& p) {
    const bool is_room = p.x() > 1 && p.x() < 9 && p.y() > 1 && p.y() < 7;
    const bool is_wall = p.x() > 0.8 && p.x() < 9.2 && p.y() > 0.8 && p.y() < 7.2;
    return is_room ? 254 : is_wall ? 0 : 205;
  });
  ASSERT_EQ(plan.lines.size(), 4U);
  for (const auto& [a, b] : plan.lines) {
    const Eigen::Vector2d along = (b - a).cwiseAbs();
    EXPECT_LT(along.minCoeff(), 1e-4);
    EXPECT_NEAR(along.maxCoeff(), along.x() > 1 ? 8.0 : 6.0, 1e-4);
  }
  EXPECT_NEAR(plan.lines[0].first.minCoeff(), 0.0, 1e-4);  // 1 m from the corner at -1, 2
}

TEST(PlanReader, TheShadesOfAGridMeanWhatItsThresholdsSay) {
  const auto shade = [](const Eigen::Vector2d& p) {
    const bool is_room = p.x() > 1 && p.x() < 9 && p.y() > 1 && p.y() < 7;
    const bool is_wall = p.x() > 0.8 && p.x() < 9.2 && p.y() > 0.8 && p.y() < 7.2;
    return is_room ? 20 : is_wall ? 180 : 100;
  };
  const PlanFile plan = readGrid(shade, "negate: 1\noccupied_thresh: 0.6\nfree_thresh: 0.3\n");
  EXPECT_EQ(plan.lines.size(), 4U);
}

TEST(PlanReader, WhereKnowledgeOfAGridEndsThereIsNoWall) {
  const PlanFile plan = readGrid([](const Eigen::Vector2d& p) {
    if (p.x() > 1 && p.x() < 5 && p.y() > 1 && p.y() < 7) return 254;
    return p.x() < 1 ? 0 : 205;
  });
  ASSERT_EQ(plan.lines.size(), 1U);
  EXPECT_NEAR((plan.lines[0].first - plan.lines[0].second).norm(), 6.0, 1e-3);
}

TEST(PlanReader, ASlantedWallOfAGridIsOneLineToACentimetre) {
  const Eigen::Vector2d normal = Eigen::Vector2d(-1.0, 2.0).normalized();
  const PlanFile plan = readGrid([&](const Eigen::Vector2d& p) {
    return normal.dot(p) < 2.0 ? 254 : normal.dot(p) < 2.4 ? 0 : 205;
  });
  const auto longest = *std::max_element(
      plan.lines.begin(), plan.lines.end(), [](const PlanLine& a, const PlanLine& b) {
        return (a.first - a.second).norm() < (b.first - b.second).norm();
      });
  EXPECT_GT((longest.first - longest.second).norm(), 9.0);
  for (const Eigen::Vector2d& end : {longest.first, longest.second}) {
    EXPECT_NEAR(normal.dot(end - Eigen::Vector2d(-1.0, 2.0)), 2.0, 0.02);
  }
}

}  // namespace
}  // namespace cca
