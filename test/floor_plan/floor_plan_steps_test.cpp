// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "drawn_map.hpp"
#include "floor_plan/components.hpp"
#include "floor_plan/distance_transform.hpp"
#include "floor_plan/furniture.hpp"
#include "floor_plan/jambs.hpp"
#include "floor_plan/main_directions.hpp"
#include "floor_plan/passages.hpp"
#include "floor_plan/polygon_measures.hpp"
#include "floor_plan/region_outline.hpp"
#include "floor_plan/room_outline.hpp"
#include "floor_plan/room_regions.hpp"
#include "floor_plan/structure.hpp"
#include "floor_plan/walls.hpp"

namespace cca {
namespace {

Mask randomMask(unsigned seed, int columns, int rows, unsigned one_in) {
  std::mt19937 random(seed);  // seeded
  Mask mask;
  mask.columns = columns;
  mask.rows = rows;
  for (int k = 0; k < columns * rows; ++k) mask.values.push_back(random() % one_in == 0);
  return mask;
}

TEST(DistanceTransform, EqualsTheSearchOfAllCells) {
  const Mask mask = randomMask(3, 23, 17, 15);
  const Raster<float> field = distanceTransform(mask);
  for (std::size_t k = 0; k < mask.values.size(); ++k) {
    const Cell c = mask.cell(k);
    double least = 1e9;
    for (int y = -1; y <= mask.rows; ++y) {
      for (int x = -1; x <= mask.columns; ++x) {
        if (mask.at({x, y}, 1)) least = std::min(least, distanceBetween(c, {x, y}));
      }
    }
    EXPECT_NEAR(field.values[k], 0.05 * least, 1e-5);
  }
}

TEST(Components, PartWhatTouchesAtACornerOnlyByTheirNeighbours) {
  Mask mask;
  mask.columns = mask.rows = 2;
  mask.values = {1, 0, 0, 1};
  EXPECT_EQ(connectedComponents(mask, 4).sizes.size(), 2u);
  EXPECT_EQ(connectedComponents(mask, 8).sizes.size(), 1u);
}

TEST(RegionOutline, EnclosesAsManyCellsAsThereAreButForPinches) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    const Components parts = connectedComponents(randomMask(seed, 15, 12, 2), 4);
    const auto outlines = outlinesOfRegions(parts.labels, static_cast<int>(parts.sizes.size()));
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      ASSERT_EQ(outlines[k].outlines.size(), 1u);
      double area = signedArea(outlines[k].outlines.front());
      for (const Polygon& hole : outlines[k].holes) area += signedArea(hole);
      EXPECT_NEAR(area, static_cast<double>(parts.sizes[k]),
                  0.05 * static_cast<double>(parts.sizes[k]));
    }
  }
}

TEST(Structure, TellsAPillarFromAWallInTheMiddleOfAHall) {
  const Polygon hall{{0, 0}, {10, 0}, {10, 8}, {0, 8}};
  const Polygon pillar{{2, 2}, {2, 2.5}, {2.5, 2.5}, {2.5, 2}};
  const Polygon wall{{5, 2}, {5, 6}, {5.2, 6}, {5.2, 2}};
  const DrawnMap map = drawMap({hall, pillar, wall}, {0.0, 0.0, 0.4});
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  const Pose2 T{0.0, 0.0, 0.4};
  const auto at = [&](const Mask& mask, double x, double y) {
    return mask[mask.cellOf(T * Eigen::Vector2d(x, y))] != 0;
  };
  EXPECT_TRUE(at(found.furniture, 2.25, 2.25));
  EXPECT_FALSE(at(found.solid, 2.25, 2.25));
  EXPECT_TRUE(at(found.solid, 5.1, 4.0));
  EXPECT_TRUE(at(found.open, 8.0, 4.0));
}

TEST(Structure, TellsAPlantBeforeAWallFromTheStubOfAWall) {
  const Pose2 T{0.013, 0.021, 0.4};
  const Polygon corridor{{0, 0}, {9, 0}, {9, 2}, {0, 2}};
  const auto block = [](double from, double to) {
    return Polygon{{from, 0}, {from, 0.5}, {to, 0.5}, {to, 0}};
  };
  // A plant, a stub, and a block in the corner, behind which no line goes on.
  const DrawnMap map = drawMap({corridor, block(3, 3.5), block(6, 6.2), block(8.5, 9)}, T);
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  const auto isSolid = [&](double x, double y) {
    return found.solid[found.solid.cellOf(T * Eigen::Vector2d(x, y))] != 0;
  };
  EXPECT_FALSE(isSolid(3.25, 0.3));
  EXPECT_TRUE(found.furniture[found.solid.cellOf(T * Eigen::Vector2d(3.25, 0.3))]);
  EXPECT_TRUE(isSolid(6.1, 0.3));
  EXPECT_TRUE(isSolid(8.75, 0.3));
  EXPECT_TRUE(isSolid(3.25, -0.04));
}

TEST(Structure, CountsNarrowUnknownStripesBetweenBeamsAsFloor) {
  OccupancyRaster grid;
  grid.columns = 60;
  grid.rows = 60;
  grid.values.assign(3600, Occupancy::kFree);
  const auto fill = [&](int from, int to, Occupancy value) {
    for (int y = 0; y < grid.rows; ++y) {
      for (int x = from; x < to; ++x) grid[{x, y}] = value;
    }
  };
  fill(0, 2, Occupancy::kUnknown);
  fill(58, 60, Occupancy::kUnknown);
  fill(10, 13, Occupancy::kUnknown);   // between two beams
  fill(20, 28, Occupancy::kUnknown);   // too wide
  fill(40, 41, Occupancy::kOccupied);  // a wall and its inside
  fill(41, 43, Occupancy::kUnknown);
  fill(43, 44, Occupancy::kOccupied);
  const Structure found = tellStructure(grid, {});
  EXPECT_FALSE(found.solid[Cell({11, 10})]);
  EXPECT_FALSE(found.open[Cell({11, 10})]);
  EXPECT_TRUE(found.solid[Cell({23, 10})]);
  EXPECT_TRUE(found.solid[Cell({41, 10})]);
  EXPECT_TRUE(found.solid[Cell({42, 10})]);
}

TEST(WallEnds, AreBothJambsOfADoor) {
  const DrawnMap map = drawMap({twoRooms()}, {0.3, 0.1, 0.6});
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  const std::vector<WallEnd> ends = freeWallEnds(found.solid, map.lines);
  ASSERT_EQ(ends.size(), 2u);
  for (const WallEnd& end : ends) EXPECT_NEAR(end.thickness, 0.12, 1e-6);
  EXPECT_NEAR((ends[0].point - ends[1].point).norm(), 0.9, 1e-6);
  EXPECT_LT(ends[0].direction.dot(ends[1].direction), -0.999);
}

TEST(GapsInWalls, AreNotBehindTheCornerOfARoom) {
  // The side walls of a room end in its corners: their lines do not go on through the wall.
  const Polygon room{{0, 0}, {4, 0}, {4, 3}, {0, 3}},
      corridor{{0, 3.15}, {4, 3.15}, {4, 4.6}, {0, 4.6}};
  const DrawnMap map = drawMap({room, corridor}, {0.02, 0.01, 0.25});
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  EXPECT_TRUE(gapsInWalls(found.solid, map.lines).empty());
}

TEST(Jambs, StandOnTheRevealWhereItIsALine) {
  const DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.0}, 0.1);
  const Passage rough{{5.06, 1.46}, {5.06, 2.45}, PassageEvidence::kCollinear};
  const Passage exact = withJambsOfLines(rough, map.lines);
  EXPECT_NEAR(exact.a.y(), 1.5, 1e-9);
  EXPECT_NEAR(exact.b.y(), 2.4, 1e-9);
}

TEST(Jambs, StandBetweenCellsAndEndsOfTheFacesOtherwise) {
  const DrawnMap map = drawMap({twoRooms()}, {0.0, 0.0, 0.0});
  const Passage rough{{5.06, 1.46}, {5.06, 2.45}, PassageEvidence::kCollinear};
  const Passage better = withJambsOfLines(rough, map.lines);
  EXPECT_NEAR(better.a.y(), 1.48, 1e-9);
  EXPECT_NEAR(better.b.y(), 2.425, 1e-9);
  const Passage alone{{1.0, 1.0}, {1.0, 2.0}, PassageEvidence::kNarrowing};
  EXPECT_EQ(withJambsOfLines(alone, map.lines).a, alone.a);
}

TEST(WallSupport, GoesOnBeyondADoorOfTheSameWall) {
  // A gap of 2 m; a wall of 1 m, a door of 0.9 m, a wall of 3 m; and beyond 2 m another wall.
  const Passage gap{{0.0, 0.0}, {2.0, 0.0}, PassageEvidence::kCollinear};
  const auto line = [](double from, double to) {
    MapLine wall;
    wall.segment.start = {from, 0.0};
    wall.segment.end = {to, 0.0};
    return wall;
  };
  EXPECT_NEAR(wallSupport(gap, {line(2.0, 3.0)}), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(wallSupport(gap, {line(2.0, 3.0), line(3.9, 6.9)}), 4.0 / 6.0, 1e-9);
  EXPECT_NEAR(wallSupport(gap, {line(2.0, 3.0), line(5.0, 9.0)}), 1.0 / 3.0, 1e-9);
  // A wall that ends 0.5 m before the jamb does not lead up to it.
  EXPECT_EQ(wallSupport(gap, {line(2.5, 6.0)}), 0.0);
}

TEST(SmallLoops, AreCutWhereTheRingCrossesItself) {
  // A step of which noise has turned the corners around.
  const Polygon crossed{{0, 0}, {4, 0}, {4, 3}, {2.0, 3}, {2.1, 2.9}, {2.1, 3.05}, {0, 3.05}};
  const Polygon clean = withoutSmallLoops(crossed);
  EXPECT_TRUE(isValidPolygon(clean, {}));
  EXPECT_NEAR(areaOf(clean, {}), 12.1, 0.1);
  const Polygon spiked{{0, 0}, {4, 0}, {4, 3}, {4, 5}, {4, 3}, {0, 3}};
  EXPECT_EQ(withoutSmallLoops(spiked).size(), 4u);
  // Collinear sides at an odd angle do not cross, whatever rounding says.
  Polygon step{{0, 0}, {2, 0}, {2, 0.5}, {3.2, 0.5}, {3.2, 0}, {6, 0}, {6, 4}, {0, 4}};
  for (auto& p : step) p = Pose2{-2.2, 0.41, 0.785} * p;
  EXPECT_EQ(withoutSmallLoops(step), step);
  const Polygon square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(withoutSmallLoops(square), square);
}

TEST(GapsAtCorners, AreTheMouthOfACorridorIntoAnEightSidedHall) {
  // The hall's walls leave the corridor at 45 degrees: no wall's line goes on across the mouth.
  const Polygon outline{{0, 0},  {4, 0}, {7, -3},    {11, -3}, {14, 0}, {14, 4},
                        {11, 7}, {7, 7}, {5.8, 5.8}, {4, 2},   {0, 2}};
  const Pose2 T{0.01, 0.02, 0.2};
  const DrawnMap map = drawMap({outline}, T);
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  const std::vector<Passage> gaps = gapsAtCorners(found.solid, map.lines);
  // Straight across from each corner.
  ASSERT_EQ(gaps.size(), 2u);
  for (const Passage& gap : gaps) {
    EXPECT_LT((gap.middle() - T * Eigen::Vector2d(4, 1)).norm(), 0.08);
    EXPECT_EQ(gap.evidence, PassageEvidence::kAtCorner);
  }
}

/// The space of two rooms of 4 m x 4 m in cells, and a wall of one cell between them.
Mask twoRoomsOfCells() {
  Mask space;
  space.columns = 163;
  space.rows = 82;
  space.values.assign(163 * 82, 0);
  for (int y = 1; y < 81; ++y) {
    for (int x = 1; x < 162; ++x) space[{x, y}] = x != 81;
  }
  return space;
}

Raster<float> clearanceOf(const Mask& space) {
  Mask solid = space;
  for (auto& cell : solid.values) cell = !cell;
  return distanceTransform(solid);
}

Mask nothingHidden(const Mask& space) { return space.alike(std::uint8_t{0}); }

TEST(RoomRegions, HaveNoDoorAlongTheFlankOfAThinWall) {
  const Mask space = twoRoomsOfCells();
  const Passage along{{4.03, 1.0}, {4.03, 2.0}, PassageEvidence::kCollinear};
  const RoomRegions rooms =
      partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {along});
  EXPECT_EQ(rooms.count, 2);
  EXPECT_TRUE(rooms.borders.empty());
}

TEST(RoomRegions, ArePartedByGapsThatNobodyPasses) {
  Mask space = twoRoomsOfCells();
  for (int y = 20; y < 24; ++y) space[{81, y}] = 1;  // 0.2 m
  for (int y = 50; y < 68; ++y) space[{81, y}] = 1;  // 0.9 m
  const Passage door{{4.08, 2.5}, {4.08, 3.4}, PassageEvidence::kCollinear};
  const RoomRegions rooms =
      partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {door});
  EXPECT_EQ(rooms.count, 2);
  EXPECT_EQ(rooms.borders.size(), 1u);
}

TEST(RoomRegions, AreNotPartedByTheNoiseOfCellsInANarrowCorridor) {
  // 1.25 m wide, for three cells 1.1 m; a wall's line goes on on both sides.
  Mask space;
  space.columns = 242;
  space.rows = 27;
  space.values.assign(242 * 27, 0);
  for (int y = 1; y < 26; ++y) {
    for (int x = 1; x < 241; ++x) space[{x, y}] = x < 120 || x > 122 || (y > 2 && y < 25);
  }
  const Passage narrow{{6.08, 0.15}, {6.08, 1.25}, PassageEvidence::kCollinear};
  EXPECT_EQ(partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {narrow}).count, 1);
}

/// Two rooms of that many cells each, and a passage of 0.15 m between.
Mask twoRoomsWithPassage(int length, int breadth, int width) {
  Mask space;
  space.columns = 2 * length + 5;
  space.rows = breadth + 2;
  space.values.assign(static_cast<std::size_t>(space.columns * space.rows), 0);
  const int from = (space.rows - width) / 2;
  for (int y = 1; y <= breadth; ++y) {
    for (int x = 1; x < space.columns - 1; ++x)
      space[{x, y}] = x <= length || x > length + 3 || (y >= from && y < from + width);
  }
  return space;
}

/// The passage of twoRoomsWithPassage().
Passage passageOf(int length, int breadth, int width, PassageEvidence evidence, double support) {
  const int from = (breadth + 2 - width) / 2;
  Passage passage{{0.05 * (length + 2.5), 0.05 * from},
                  {0.05 * (length + 2.5), 0.05 * (from + width)},
                  evidence};
  passage.support = support;
  return passage;
}

TEST(RoomRegions, AreNotPartedAcrossACorridorBetweenItsRecesses) {
  // 2.1 m wide but for a stretch of 1.7 m, as between the recesses of doors on both sides: in rooms
  // of that breadth it is an opening, in a corridor none; one of 1.5 m is in both.
  const auto count = [](int length, int width) {
    const Mask space = twoRoomsWithPassage(length, 42, width);
    const Passage gap = passageOf(length, 42, width, PassageEvidence::kAbutting, 0.9);
    return partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {gap}).count;
  };
  EXPECT_EQ(count(80, 34), 2);
  EXPECT_EQ(count(120, 34), 1);
  EXPECT_EQ(count(120, 30), 2);
}

TEST(RoomRegions, ArePartedAtANarrowingWithAsMuchWallAsGap) {
  const Mask space = twoRoomsWithPassage(80, 80, 56);  // 4 m by 4 m, 2.8 m between
  const auto count = [&](double support) {
    const Passage narrow = passageOf(80, 80, 56, PassageEvidence::kNarrowing, support);
    return partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {narrow}).count;
  };
  EXPECT_EQ(count(0.4), 1);
  EXPECT_EQ(count(0.5), 2);
}

TEST(RoomRegions, AreNoSmallOnesThatNoPassageLeadsInto) {
  const auto count = [](int length, int of_the_first) {
    Mask space = twoRoomsWithPassage(length, 42, 4);  // 0.2 m between
    for (int x = of_the_first + 1; x <= length; ++x) {
      for (int y = 1; y <= 42; ++y) space[{x, y}] = 0;
    }
    return partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {}).count;
  };
  EXPECT_EQ(count(80, 40), 2);  // 2 m by 2.1 m, and 4 m by 2.1 m
  EXPECT_EQ(count(80, 36), 1);
  EXPECT_EQ(count(36, 30), 1);  // the largest is one in any case
}

TEST(RoomRegions, ArePartedAtANarrowingInAWallByTheirAreas) {
  // A shallow room along a corridor of 2 m, its front of 1.5 m in the long side: a narrowing is
  // compared with twice the depth of the room, one in a wall with the side of a square.
  Mask space;
  space.columns = 242;
  space.rows = 83;
  space.values.assign(242 * 83, 0);
  for (int y = 1; y < 82; ++y) {
    for (int x = 1; x < 241; ++x)
      space[{x, y}] = y < 41 || (y > 43 && x > 60 && x < 200) || (x > 100 && x < 131);
  }
  Passage front{{5.05, 2.12}, {6.55, 2.12}, PassageEvidence::kNarrowing};
  const auto count = [&] {
    return partitionIntoRooms(space, clearanceOf(space), nothingHidden(space), {front}).count;
  };
  EXPECT_EQ(count(), 1);
  front.support = 0.5;
  EXPECT_EQ(count(), 2);
}

MapLine lineAt(double degrees, double sigma_deg, double length = 4.0) {
  MapLine line;
  const double angle = degrees * kRadiansPerDegree;
  line.segment.start = {1.0, 2.0};
  line.segment.end =
      line.segment.start + length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  line.segment.covariance(1, 1) = std::pow(sigma_deg * kRadiansPerDegree, 2);
  return line;
}

double degreesOf(const MapLine& line) {
  const Eigen::Vector2d along = line.segment.direction();
  return std::atan2(along.y(), along.x()) / kRadiansPerDegree;
}

TEST(MainDirections, AreThoseThatWallsShareOrStandSquareTo) {
  const std::vector<MainDirection> found =
      mainDirections({lineAt(89.95, 0.1), lineAt(30.0, 0.1), lineAt(-59.9, 0.1), lineAt(0.05, 0.1),
                      lineAt(-150.0, 0.1), lineAt(180.0, 0.1), lineAt(45.0, 0.0)});
  ASSERT_EQ(found.size(), 2u) << "what is told no deviation says nothing";
  EXPECT_NEAR(found[0].angle / kRadiansPerDegree, 0.0, 1e-9) << "89.95, .05 and 180";
  EXPECT_NEAR(found[1].angle / kRadiansPerDegree, 30.0 + 0.1 / 3.0, 1e-9);
  EXPECT_NEAR(std::sqrt(found[0].variance) / kRadiansPerDegree, 0.1 / std::sqrt(3.0), 1e-9);
}

TEST(MainDirections, AreAsManyAsTheDeviationsOfWallsSay) {
  EXPECT_EQ(mainDirections({lineAt(10.0, 0.1), lineAt(10.25, 0.1)}).size(), 1u);
  EXPECT_EQ(mainDirections({lineAt(10.0, 0.05), lineAt(10.25, 0.05)}).size(), 2u);
  EXPECT_TRUE(mainDirections({}).empty());
}

TEST(MainDirections, TurnAWallAboutItsMiddleAsFarAsItsDeviationsAllow) {
  const std::vector<MapLine> lines{lineAt(20.0, 0.01), lineAt(110.3, 0.2), lineAt(20.5, 0.2),
                                   lineAt(20.3, 0.0)};
  const std::vector<MapLine> turned =
      alongMainDirections(lines, {{20.0 * kRadiansPerDegree, 1e-8}});
  EXPECT_NEAR(degreesOf(turned[1]), 110.0, 1e-9);
  EXPECT_LT((0.5 * (turned[1].segment.start + turned[1].segment.end) -
             0.5 * (lines[1].segment.start + lines[1].segment.end))
                .norm(),
            1e-12);
  EXPECT_NEAR(turned[1].segment.length(), 4.0, 1e-12);
  EXPECT_EQ(turned[2].segment.end, lines[2].segment.end) << "2.5 deviations off";
  EXPECT_EQ(turned[3].segment.end, lines[3].segment.end) << "it is told to be exact";
  EXPECT_EQ(alongMainDirections(lines, {})[1].segment.end, lines[1].segment.end);
}

TEST(MainDirections, TurnAWallIntoTheBestKnownOneNotTheNearest) {
  const std::vector<MainDirection> directions{{0.0, 1e-8}, {1.3 * kRadiansPerDegree, 1e-4}};
  const auto turned = [&](double sigma_deg) {
    return degreesOf(alongMainDirections({lineAt(1.0, sigma_deg)}, directions)[0]);
  };
  EXPECT_NEAR(turned(0.6), 0.0, 1e-9);
  EXPECT_NEAR(turned(0.3), 1.3, 1e-9) << "the other is too far off";
}

TEST(MainDirections, AreNotMadeByDeviationsThatAreNoNumbers) {
  for (const double odd :
       {std::numeric_limits<double>::quiet_NaN(), -1.0, std::numeric_limits<double>::infinity()}) {
    std::vector<MapLine> lines{lineAt(20.0, 0.1), lineAt(20.1, 0.1)};
    lines[1].segment.covariance(1, 1) = odd;
    const std::vector<MainDirection> found = mainDirections(lines);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].angle, 20.0 * kRadiansPerDegree, 1e-12);
    EXPECT_TRUE(alongMainDirections(lines, found)[1].segment.end.allFinite());
  }
  EXPECT_EQ(alongMainDirections({lineAt(20.0, 1000.0)}, {})[0].segment.end,
            lineAt(20.0, 1000.0).segment.end)
      << "there is no direction";
}

TEST(Walls, OfOneFaceHaveNoThickness) {
  const DrawnMap map = drawMap({{{0, 0}, {5, 0}, {5, 4}, {0, 4}}}, {0.0, 0.0, 0.0});
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  const std::vector<PlanWall> walls = wallsOfLines(found.solid, map.lines);
  ASSERT_EQ(walls.size(), 4u);
  for (const PlanWall& wall : walls) {
    EXPECT_EQ(wall.thickness, 0.0);
    EXPECT_TRUE(wall.right.empty());
  }
}

TEST(Walls, AreNotPairedAcrossOpenFloor) {
  // A passage of 0.5 m between two blocks: its faces look at each other, not away.
  const DrawnMap map = drawMap({{{0, 0}, {5, 0}, {5, 0.5}, {0, 0.5}}}, {0.0, 0.0, 0.1});
  const Structure found = tellStructure(cropToKnown(map.grid, 2), map.lines);
  for (const PlanWall& wall : wallsOfLines(found.solid, map.lines)) EXPECT_EQ(wall.thickness, 0.0);
}

TEST(Furniture, IsNotCutWhereAnotherRoomLiesInside) {
  Polygon outline{{0, 0}, {2, 0}, {2, 0.9}, {3.2, 0.9}, {3.2, 0}, {6, 0}, {6, 4}, {0, 4}};
  Raster<int> rooms;
  rooms.columns = 140;
  rooms.rows = 100;
  rooms.values.assign(14000, 1);
  EXPECT_TRUE(cutLeaning(outline, rooms, {}).empty());
  EXPECT_EQ(outline.size(), 8u);
  rooms.values.assign(14000, 0);
  EXPECT_EQ(cutLeaning(outline, rooms, {}).size(), 1u);
  EXPECT_EQ(outline.size(), 4u);
}

TEST(Furniture, IsNotTheWallBetweenTwoDoors) {
  // A corridor whose doors stand in the middle of a wall of 0.5 m.
  const Polygon corridor{{0, 0}, {1, 0}, {1, 0.25}, {4, 0.25}, {4, 0}, {5, 0}, {5, 2}, {0, 2}};
  const std::vector<Passage> doors{{{0, 0}, {1, 0}, PassageEvidence::kCollinear},
                                   {{4, 0}, {5, 0}, PassageEvidence::kCollinear}};
  Raster<int> rooms;
  rooms.columns = 120;
  rooms.rows = 60;
  rooms.values.assign(7200, 0);
  Polygon outline = corridor;
  EXPECT_TRUE(cutLeaning(outline, rooms, doors).empty());
  EXPECT_EQ(outline.size(), corridor.size());
  EXPECT_EQ(cutLeaning(outline, rooms, {}).size(), 1u);
}

TEST(RoomOutline, IsSquareWhereItsLinesAreByTheirDeviations) {
  for (const double sigma_deg : {0.5, 0.01}) {
    DrawnMap map = drawMap({{{0, 0}, {5, 0}, {5, 4}, {0, 4}}}, {0.4, 0.7, 0.3}, 0.25, 0.004);
    for (MapLine& line : map.lines)
      line.segment.covariance(1, 1) = std::pow(sigma_deg * kRadiansPerDegree, 2);
    const FloorPlan plan = floorPlan(map.grid, map.lines);
    ASSERT_EQ(plan.rooms.size(), 1u);
    const Polygon& outline = plan.rooms[0].outline;
    ASSERT_EQ(outline.size(), 4u);
    double worst = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d side = outline[(k + 1) % 4] - outline[k],
                            next = outline[(k + 2) % 4] - outline[(k + 1) % 4];
      worst = std::max(worst, std::abs(side.normalized().dot(next.normalized())));
    }
    if (sigma_deg > 0.1) {
      EXPECT_LT(worst, 1e-9);
    } else {
      EXPECT_GT(worst, 1e-4) << "nothing is made square that is not";
    }
  }
}

TEST(RoomOutline, FollowsTheLinesAndNotTheCells) {
  const Pose2 T{0.013, 0.021, 0.3};
  const Polygon room{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  const DrawnMap map = drawMap({room}, T);
  Mask open = map.grid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < open.values.size(); ++k)
    open.values[k] = map.grid.values[k] == Occupancy::kFree;
  const Components parts = connectedComponents(open, 4);
  const auto border = outlinesOfRegions(parts.labels, 1).front();
  const Polygon drawn = outlineAlongLines(parts.labels, border.outlines.front(), map.lines, {});
  ASSERT_EQ(drawn.size(), 4u);
  for (const auto& corner : drawn) {
    double least = 1e9;
    for (const auto& p : room) least = std::min(least, (T * p - corner).norm());
    EXPECT_LT(least, 1e-9);
  }
}

}  // namespace
}  // namespace cca
