// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/floor_plan/floor_plan.hpp"

#include <gtest/gtest.h>

#include <random>

#include "drawn_map.hpp"
#include "floor_plan/polygon_measures.hpp"

namespace cca {
namespace {

const Pose2 kPlaces[] = {{0.0, 0.0, 0.0},
                         {0.013, 0.027, 0.0},
                         {3.21, -1.17, 0.35},
                         {-2.2, 0.41, 0.785},
                         {1.0, 2.0, 1.9}};

class FloorPlanAt : public testing::TestWithParam<Pose2> {};

TEST_P(FloorPlanAt, FindsTwoRoomsAndTheirDoor) {
  const DrawnMap map = drawMap({twoRooms()}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 2u);
  const PlanRoom& large = plan.rooms[plan.rooms[0].area > plan.rooms[1].area ? 0 : 1];
  const PlanRoom& small = plan.rooms[&large == &plan.rooms[0] ? 1 : 0];
  // Each with half of the reveal, 0.9 m x 0.06 m.
  EXPECT_NEAR(large.area, 20.0 + 0.054, 0.01 * 20.0);
  EXPECT_NEAR(small.area, 12.0 + 0.054, 0.01 * 12.0);
  EXPECT_NEAR(large.perimeter, 18.0 + 0.12,
              0.2);  // the reveal is too short for a line, and follows the cells
  ASSERT_EQ(plan.openings.size(), 1u);
  const PlanOpening& door = plan.openings.front();
  EXPECT_EQ(door.kind, OpeningKind::kDoor);
  EXPECT_NEAR(door.width(), 0.9, 0.04);
  const Eigen::Vector2d middle = GetParam() * Eigen::Vector2d(5.06, 1.95);
  EXPECT_LT((0.5 * (door.a + door.b) - middle).norm(), 0.08);
  EXPECT_NE(door.rooms[0], door.rooms[1]);
}

TEST(FloorPlanOf, LinesThatLeaveTheGridCostNoMoreThanTheGrid) {
  DrawnMap map = drawMap({twoRooms()}, Pose2());
  MapLine far = map.lines.front();
  far.id = map.lines.size() + 1;
  far.segment.start = {-2e7, -3.0};  // 4 10^8 cells, in parts within 1 m of the grid
  far.segment.end = {2e7, -3.0};
  map.lines.push_back(far);
  far.segment.start = {-1e7, -0.5};
  far.segment.end = {1e7, -0.5};
  map.lines.push_back(far);
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  EXPECT_EQ(plan.rooms.size(), 2u);
  for (const PlanWall& wall : plan.walls) EXPECT_LT((wall.end - wall.start).norm(), 20.0);
}

TEST_P(FloorPlanAt, KnowsTheThicknessOfTheWallBetween) {
  const DrawnMap map = drawMap({twoRooms()}, GetParam());
  int two_faced = 0;
  for (const PlanWall& wall : floorPlan(map.grid, map.lines).walls) {
    if (wall.thickness <= 0.0) continue;
    ++two_faced;
    EXPECT_NEAR(wall.thickness, 0.12, 0.005);
    EXPECT_EQ(wall.left.size(), 1u);
    EXPECT_EQ(wall.right.size(), 1u);
  }
  EXPECT_EQ(two_faced, 2);  // on both sides of the door
}

TEST_P(FloorPlanAt, KnowsACorridorFromItsRooms) {
  // 12 m x 1.6 m, three rooms of 3.9 m x 3 m above, their doors of 0.85 m off the middle.
  Polygon outline{{0, 0}, {12, 0}, {12, 1.6}};
  for (const double x : {8.1, 4.05, 0.0}) {
    for (const auto& p : Polygon{{x + 2.0, 1.6},
                                 {x + 2.0, 1.75},
                                 {x + 3.9, 1.75},
                                 {x + 3.9, 4.75},
                                 {x, 4.75},
                                 {x, 1.75},
                                 {x + 1.15, 1.75},
                                 {x + 1.15, 1.6}})
      outline.push_back(p);
  }
  outline.emplace_back(0, 1.6);
  const DrawnMap map = drawMap({outline}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  EXPECT_EQ(plan.rooms.size(), 4u);
  EXPECT_EQ(plan.openings.size(), 3u);
  for (const PlanOpening& door : plan.openings) EXPECT_NEAR(door.width(), 0.85, 0.05);
}

TEST_P(FloorPlanAt, PartsACorridorFromAHallWhoseWallIsTheCorridorsToo) {
  // Walls in cells have steps: the hall's own line ends before the mouth, what is left of it is
  // short.
  DrawnMap map =
      drawMap({{{0, 0}, {12, 0}, {12, 1.2}, {6, 1.2}, {6, 1.6}, {6.05, 1.6}, {6.05, 5}, {0, 5}}},
              GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 2u);
  EXPECT_NEAR(std::max(plan.rooms[0].area, plan.rooms[1].area), 30.0, 0.3);
  ASSERT_EQ(plan.openings.size(), 1u);
  EXPECT_NEAR(plan.openings[0].width(), 1.2, 0.05);
}

TEST_P(FloorPlanAt, KeepsACorridorWithAnAlcoveWhole) {
  const DrawnMap map =
      drawMap({{{0, 0}, {16, 0}, {16, 1.6}, {10, 1.6}, {10, 3.1}, {5, 3.1}, {5, 1.6}, {0, 1.6}}},
              GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, 33.1, 0.34);
}

TEST_P(FloorPlanAt, PartsRoomsAtAPillarBetweenTwoOpenings) {
  // 3.9 m from wall to wall, more than any opening: the pillar makes two of 1.7 m.
  const Polygon hall{{0, 0}, {4, 0},    {4, 1.05},    {4.15, 1.05}, {4.15, 0}, {8, 0},
                     {8, 6}, {4.15, 6}, {4.15, 4.95}, {4, 4.95},    {4, 6},    {0, 6}};
  const Polygon pillar{{3.85, 2.75}, {3.85, 3.25}, {4.3, 3.25}, {4.3, 2.75}};
  const DrawnMap map = drawMap({hall, pillar}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  EXPECT_EQ(plan.rooms.size(), 2u);
  ASSERT_EQ(plan.openings.size(), 2u);
  for (const PlanOpening& opening : plan.openings) EXPECT_NEAR(opening.width(), 1.7, 0.1);
}

TEST_P(FloorPlanAt, KeepsAHallWholeWhereASlantedWallEndsBeforeItsOtherSide) {
  // The wall leads past the gap of 2.6 m at its end, not across it.
  const DrawnMap map = drawMap(
      {{{0, 0}, {20, 0}, {20, 12}, {14.2, 12}, {6.2, 2.6}, {6.0, 2.8}, {13.8, 12}, {0, 12}}},
      GetParam());
  EXPECT_EQ(floorPlan(map.grid, map.lines).rooms.size(), 1u);
}

TEST_P(FloorPlanAt, PartsAShallowRoomFromTheCorridorThatItLiesAlong) {
  // 5 m x 1.5 m, its opening of 1.7 m in the long side: wider than the room is deep.
  const DrawnMap map = drawMap({{{0, 0},
                                 {14, 0},
                                 {14, 2},
                                 {8.2, 2},
                                 {8.2, 2.12},
                                 {10, 2.12},
                                 {10, 3.62},
                                 {5, 3.62},
                                 {5, 2.12},
                                 {6.5, 2.12},
                                 {6.5, 2},
                                 {0, 2}}},
                               GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 2u);
  EXPECT_NEAR(std::min(plan.rooms[0].area, plan.rooms[1].area), 7.6, 0.2);
}

TEST_P(FloorPlanAt, KnowsARoomThatWasGlimpsedThroughItsDoor) {
  // Seen from (6, -3.6): little more than the door is wide, the sides of the room are unknown.
  DrawnMap map = drawMap({{{0, -4},
                           {12, -4},
                           {12, 2},
                           {6.8, 2},
                           {6.8, 2.12},
                           {9, 2.12},
                           {9, 5},
                           {3, 5},
                           {3, 2.12},
                           {5.2, 2.12},
                           {5.2, 2},
                           {0, 2}}},
                         GetParam());
  const auto isSeen = [](const Eigen::Vector2d& p) {
    return p.y() < 2.1 || std::abs(p.x() - 6.0) < 0.8 * (p.y() + 3.6) / 5.72;
  };
  for (std::size_t k = 0; k < map.grid.values.size(); ++k) {
    const Eigen::Vector2d p = map.grid.centreOf(map.grid.cell(k));
    if (!isSeen(GetParam().inverse() * p)) map.grid.values[k] = Occupancy::kUnknown;
  }
  std::vector<MapLine> seen;
  for (const MapLine& line : map.lines) {
    const Pose2 back = GetParam().inverse();
    if (isSeen(back * line.segment.start) && isSeen(back * line.segment.end)) seen.push_back(line);
  }
  const FloorPlan plan = floorPlan(map.grid, seen);
  ASSERT_EQ(plan.rooms.size(), 2u);
  ASSERT_EQ(plan.openings.size(), 1u);
  EXPECT_NEAR(plan.openings[0].width(), 1.6, 0.1);
}

TEST_P(FloorPlanAt, LeavesOutWhatBeamsThroughAWindowShow) {
  const DrawnMap map = drawMap(
      {{{0, 0}, {4, 0}, {4, 1.9}, {12, 1.9}, {12, 2.1}, {4, 2.1}, {4, 4}, {0, 4}}}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, 16.0, 0.16);
}

TEST_P(FloorPlanAt, KeepsAnLShapedRoomWhole) {
  const DrawnMap map = drawMap({{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 6}, {0, 6}}}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, 27.0, 0.27);
  EXPECT_EQ(plan.rooms[0].outline.size(), 6u);
}

TEST_P(FloorPlanAt, TakesAFreeStandingTableForFurniture) {
  const Polygon table{{2.0, 2.0}, {2.0, 2.8}, {2.7, 2.8}, {2.7, 2.0}};
  const DrawnMap map = drawMap({{{0, 0}, {6, 0}, {6, 5}, {0, 5}}, table}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, 30.0, 0.3);
  EXPECT_TRUE(plan.rooms[0].holes.empty());
  ASSERT_EQ(plan.furniture.size(), 1u);
  EXPECT_FALSE(plan.furniture[0].leans);
  EXPECT_EQ(plan.furniture[0].room, 1);
}

TEST_P(FloorPlanAt, PresumesTheWallBehindACabinet) {
  const DrawnMap map = drawMap(
      {{{0, 0}, {2, 0}, {2, 0.5}, {3.2, 0.5}, {3.2, 0}, {6, 0}, {6, 4}, {0, 4}}}, GetParam());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, 24.0, 0.24);
  EXPECT_NEAR(plan.rooms[0].unseen_area, 0.6, 0.2);
  ASSERT_EQ(plan.furniture.size(), 1u);
  EXPECT_TRUE(plan.furniture[0].leans);
  EXPECT_NEAR(areaOf(plan.furniture[0].outline, {}), 0.6, 0.03);
  const auto presumed = std::find_if(plan.walls.begin(), plan.walls.end(),
                                     [](const PlanWall& wall) { return wall.is_presumed; });
  ASSERT_NE(presumed, plan.walls.end());
  EXPECT_NEAR((presumed->end - presumed->start).norm(), 1.2, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Places, FloorPlanAt, testing::ValuesIn(kPlaces));

TEST(FloorPlan, SurvivesNoiseOfTheLines) {
  const DrawnMap map = drawMap({twoRooms()}, {0.4, 0.3, 0.5}, 0.25, 0.01);
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 2u);
  EXPECT_NEAR(plan.rooms[0].area + plan.rooms[1].area, 32.1, 0.4);
}

TEST(FloorPlan, PartsRoomsWithoutLinesByTheirNarrowing) {
  const DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.3});
  const FloorPlan plan = floorPlan(map.grid, {});
  ASSERT_EQ(plan.rooms.size(), 2u);
  EXPECT_NEAR(plan.rooms[0].area + plan.rooms[1].area, 32.1, 1.0);
  EXPECT_TRUE(plan.walls.empty());
}

TEST(FloorPlan, TakesARoundHallForOneRoom) {
  Polygon hall;
  for (int k = 0; k < 48; ++k)
    hall.push_back(6.0 * Eigen::Vector2d(std::cos(k * M_PI / 24), std::sin(k * M_PI / 24)));
  const DrawnMap map = drawMap({hall}, {0.01, 0.02, 0.0});
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, M_PI * 36.0, 1.5);
}

TEST(FloorPlan, FindsTheRoomsOfTwoBuildings) {
  Polygon far = twoRooms();
  for (auto& p : far) p += Eigen::Vector2d(30.0, 5.0);
  const DrawnMap map = drawMap({twoRooms(), far}, {0.0, 0.0, 0.1});
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  EXPECT_EQ(plan.rooms.size(), 4u);
  EXPECT_EQ(plan.openings.size(), 2u);
}

TEST(FloorPlan, TakesBeamsThroughAWindowForNoRoom) {
  DrawnMap map = drawMap({{{0, 0}, {5, 0}, {5, 4}, {0, 4}}}, {0.0, 0.0, 0.0});
  OccupancyRaster wide = map.grid;  // with 5 m beyond the wall
  wide.columns += 100;
  wide.values.assign(static_cast<std::size_t>(wide.columns * wide.rows), Occupancy::kUnknown);
  for (int y = 0; y < wide.rows; ++y) {
    for (int x = 0; x < map.grid.columns; ++x) wide[{x, y}] = map.grid[{x, y}];
  }
  // Four beams of 0.1 m, 0.15 m apart, through a window of 0.4 m.
  const Cell window = wide.cellOf({5.02, 2.0});
  for (int y = -4; y < 4; ++y) {
    for (int x = -1; x < 3; ++x) wide[window + Cell{x, y}] = Occupancy::kFree;
  }
  for (int beam = 0; beam < 4; ++beam) {
    for (int x = 3; x < 90; ++x) {
      for (int y = 0; y < 2; ++y) wide[window + Cell{x, 5 * beam - 9 + y}] = Occupancy::kFree;
    }
  }
  const FloorPlan plan = floorPlan(wide, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area, 20.0, 0.2);
}

TEST(FloorPlan, LabelsARoomWhereMostFloorIsFreeWithinIt) {
  // A hall, and a room that narrows away from its door; a table in the middle of the hall.
  const Polygon outline{{0, 0},   {6, 0},      {6, 2},      {6.12, 2}, {6.12, 1.9}, {9, 2.1},
                        {9, 2.8}, {6.12, 3.0}, {6.12, 2.9}, {6, 2.9},  {6, 6},      {0, 6}};
  const Polygon table{{2.6, 2.6}, {2.6, 3.4}, {3.4, 3.4}, {3.4, 2.6}};
  const DrawnMap map = drawMap({outline, table}, {0.0, 0.0, 0.0});
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 2u);
  const PlanRoom& hall = plan.rooms[plan.rooms[0].area > 10.0 ? 0 : 1];
  const PlanRoom& narrow = plan.rooms[plan.rooms[0].area > 10.0 ? 1 : 0];
  EXPECT_EQ(roomAt(plan, hall.label), hall.id);
  EXPECT_GT((hall.label - Eigen::Vector2d(3.0, 3.0)).norm(), 1.3);  // not on the table
  EXPECT_EQ(roomAt(plan, narrow.label), narrow.id);
  EXPECT_GT(narrow.label.x(), 6.5);  // not in the door
  EXPECT_NEAR(narrow.label.y(), 2.45, 0.1);
}

TEST(FloorPlan, SaysWhereAnUnfinishedMapEnds) {
  DrawnMap map = drawMap({{{0, 0}, {8, 0}, {8, 4}, {0, 4}}}, {0.0, 0.0, 0.0});
  const double whole = floorPlan(map.grid, map.lines).rooms.at(0).open_border;
  EXPECT_LT(whole, 0.3);
  for (std::size_t k = 0; k < map.grid.values.size(); ++k) {
    if (map.grid.centreOf(map.grid.cell(k)).x() > 5.0) map.grid.values[k] = Occupancy::kUnknown;
  }
  map.lines.erase(std::remove_if(map.lines.begin(), map.lines.end(),
                                 [](const MapLine& line) {
                                   return line.segment.start.x() > 7.0 &&
                                          line.segment.end.x() > 7.0;
                                 }),
                  map.lines.end());
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].open_border, 4.0, 0.5);
  EXPECT_NEAR(plan.rooms[0].area, 20.0, 0.5);  // no room over what is unknown
}

TEST(FloorPlan, IsEmptyWhereNothingIsKnown) {
  EXPECT_TRUE(floorPlan({}, {}).rooms.empty());
  OccupancyRaster unknown;
  unknown.columns = unknown.rows = 40;
  unknown.values.assign(1600, Occupancy::kUnknown);
  MapLine line;
  line.segment.end = {1.0, 1.0};
  EXPECT_TRUE(floorPlan(unknown, {line}).rooms.empty());
}

TEST(FloorPlan, TakesASingleWallForAWallAndItsForegroundForAnOpenRoom) {
  DrawnMap map = drawMap({{{0, 0}, {5, 0}, {5, 2}, {0, 2}}}, {0.0, 0.0, 0.2});
  map.lines.resize(1);
  for (auto& cell : map.grid.values) {
    if (cell == Occupancy::kOccupied) cell = Occupancy::kUnknown;
  }
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.walls.size(), 1u);
  EXPECT_EQ(plan.walls[0].thickness, 0.0);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_GT(plan.rooms[0].open_border, 7.0);
}

TEST(FloorPlan, SaysOfEachRoomHowMuchOfItNobodySaw) {
  // The hidden half of a room, behind a row of furniture without lines: no part of it counts as
  // seen.
  DrawnMap map = drawMap({{{0, 0}, {8, 0}, {8, 4}, {0, 4}}}, {0.0, 0.0, 0.2});
  for (std::size_t k = 0; k < map.grid.values.size(); ++k) {
    const Eigen::Vector2d p = Pose2{0.0, 0.0, 0.2}.inverse() * map.grid.centreOf(map.grid.cell(k));
    if (p.x() > 3.0 && p.x() < 4.5 && p.y() > 1.0 && p.y() < 2.5)
      map.grid.values[k] = Occupancy::kUnknown;
  }
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_NEAR(plan.rooms[0].area - plan.rooms[0].unseen_area, 32.0 - 1.5 * 1.5, 0.5);
}

TEST(FloorPlan, CoversNoUnknownGroundWithoutSayingSo) {
  // As of an unfinished drive: what lies in a wedge that turns about the building is unknown.
  for (int k = 0; k < 24; ++k) {
    DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.1 * k});
    const Eigen::Vector2d middle = Pose2{0.0, 0.0, 0.1 * k} * Eigen::Vector2d(4.0, 2.0);
    const Eigen::Vector2d ahead(std::cos(0.7 * k), std::sin(0.7 * k));
    double known = 0.0;
    for (std::size_t c = 0; c < map.grid.values.size(); ++c) {
      const Eigen::Vector2d off = map.grid.centreOf(map.grid.cell(c)) - middle;
      if (off.dot(ahead) > 0.4 * off.norm()) map.grid.values[c] = Occupancy::kUnknown;
      known += map.grid.values[c] == Occupancy::kFree ? 0.0025 : 0.0;
    }
    map.lines.erase(
        std::remove_if(map.lines.begin(), map.lines.end(),
                       [&](const MapLine& line) {
                         return ahead.dot(0.5 * (line.segment.start + line.segment.end) - middle) >
                                0.0;
                       }),
        map.lines.end());
    const FloorPlan plan = floorPlan(map.grid, map.lines);
    double seen = 0.0, area = 0.0, open = 0.0;
    for (const PlanRoom& room : plan.rooms) {
      area += room.area;
      seen += room.area - room.unseen_area;
      open += room.open_border;
    }
    EXPECT_LT(seen, known + 0.6) << k;  // walls between cells and lines
    EXPECT_LT(area, known + 1.5) << k;
    EXPECT_GT(open, 1.0) << k;
  }
}

TEST(FloorPlan, GivesValidPolygonsOfAnyClutter) {
  // As of raw odometry: walls many times over, at all angles, cells at random.
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);  // seeded
    std::uniform_real_distribution<double> anywhere(-1.0, 9.0);
    DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.1 * seed});
    for (auto& cell : map.grid.values) {
      if (random() % 12 == 0) cell = static_cast<Occupancy>(random() % 3);
    }
    for (int k = 0; k < 60; ++k) {
      MapLine line;
      line.id = 100 + static_cast<std::uint64_t>(k);
      line.segment.start = {anywhere(random), anywhere(random)};
      line.segment.end =
          k % 10 ? Eigen::Vector2d(anywhere(random), anywhere(random)) : line.segment.start;
      map.lines.push_back(line);
    }
    const FloorPlan plan = floorPlan(map.grid, map.lines);
    for (const PlanRoom& room : plan.rooms) {
      EXPECT_TRUE(isValidPolygon(room.outline, room.holes))
          << "seed " << seed << ", room " << room.id;
      EXPECT_GT(room.area, 0.0);
    }
  }
}

TEST(FloorPlan, IsTheSameEachTime) {
  const DrawnMap map = drawMap({twoRooms()}, {0.1, 0.2, 0.3});
  const FloorPlan one = floorPlan(map.grid, map.lines), other = floorPlan(map.grid, map.lines);
  ASSERT_EQ(one.rooms.size(), other.rooms.size());
  for (std::size_t k = 0; k < one.rooms.size(); ++k) {
    ASSERT_EQ(one.rooms[k].outline.size(), other.rooms[k].outline.size());
    for (std::size_t i = 0; i < one.rooms[k].outline.size(); ++i)
      EXPECT_EQ(one.rooms[k].outline[i], other.rooms[k].outline[i]);
  }
}

TEST(FloorPlan, IsTheSameHoweverTheCellsWereCutOut) {
  // The origin of the larger grid, plus 27 cells, is that of the smaller but for the last bit.
  const DrawnMap map = drawMap({twoRooms()}, {-24.15, -7.75, 0.0});
  OccupancyRaster larger = map.grid.alike(Occupancy::kUnknown);
  larger.columns += 27;
  larger.values.assign(larger.values.size() + static_cast<std::size_t>(27 * larger.rows),
                       Occupancy::kUnknown);
  larger.origin.x() = -26.0;
  OccupancyRaster smaller = map.grid;
  smaller.origin.x() = 0.05 * -493.0;  // -24.650000000000002
  for (std::size_t k = 0; k < smaller.values.size(); ++k) {
    const Cell c = smaller.cell(k);
    larger[c + Cell{27, 0}] = smaller.values[k];
  }
  const FloorPlan one = floorPlan(smaller, map.lines), other = floorPlan(larger, map.lines);
  ASSERT_EQ(one.rooms.size(), 2u);
  ASSERT_EQ(other.rooms.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(one.rooms[k].outline, other.rooms[k].outline);
}

TEST(FloorPlan, TakesNoDottedLineForAWall) {
  DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.0});
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  MapLine pane = map.lines.front();
  pane.id = 99;
  pane.kind = LineKind::kDotted;
  pane.segment.start = {2.5, 0.5};
  pane.segment.end = {2.5, 3.5};
  map.lines.push_back(pane);
  EXPECT_EQ(floorPlan(map.grid, map.lines).walls.size(), plan.walls.size());
}

TEST(FloorPlan, TellsTheRoomOfAPoint) {
  const DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.0});
  const FloorPlan plan = floorPlan(map.grid, map.lines);
  EXPECT_NE(roomAt(plan, {1.0, 1.0}), 0);
  EXPECT_NE(roomAt(plan, {7.0, 1.0}), 0);
  EXPECT_NE(roomAt(plan, {1.0, 1.0}), roomAt(plan, {7.0, 1.0}));
  EXPECT_EQ(roomAt(plan, {5.06, 0.5}), 0);  // in the wall
}

}  // namespace
}  // namespace cca
