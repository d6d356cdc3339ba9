// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "simulation/building_kinds.hpp"
#include "simulation/furniture.hpp"

namespace cca {

/// 60 x 40 m: two blocks of six racks 22 m long, an office in a corner, pallets.
Building warehouse(Random& random) {
  Building plan;
  plan.width = 60.0;
  plan.height = 40.0;
  plan.start = {3.0, 3.0, 0.0};
  plan.addOuterWalls(kOuterWall);
  for (int row = 0; row < 6; ++row) {
    const double y = 6.0 + 4.5 * row;
    plan.addBox({6.0, y}, {28.0, y + 1.2});
    plan.addBox({31.0, y}, {53.0, y + 1.2});
  }
  plan.addWall({45.0, 34.0}, {60.0, 34.0}, kInnerWall, {{2.0, 3.2}});
  plan.addWall({45.0, 34.0}, {45.0, 40.0}, kInnerWall, {{2.0, 3.0}});
  const Box office_door(Eigen::Vector2d(47.0, 33.95), Eigen::Vector2d(48.2, 34.05));
  const Box side_door(Eigen::Vector2d(44.95, 36.0), Eigen::Vector2d(45.05, 37.0));
  furnish(
      plan,
      {Box(Eigen::Vector2d(45.05, 34.05), Eigen::Vector2d(59.8, 39.8)), {office_door, side_door}},
      8, random);
  furnish(plan, {Box(Eigen::Vector2d(2.0, 34.0), Eigen::Vector2d(43.0, 39.8)), {}}, 8, random);
  for (double y : {8.9, 17.9, 26.9}) plan.addDisc({29.5, y}, 0.3);  // columns of the roof
  return plan;
}

/// 24 x 16 m: one corridor around a solid core, with three niches.
Building corridorLoop(Random&) {
  Building plan;
  plan.width = 24.0;
  plan.height = 16.0;
  plan.start = {1.2, 1.2, 0.0};
  plan.addOuterWalls(kOuterWall);
  const double wide = 2.0 + kOuterWall;  // the core, less the niches
  plan.addBox({wide, wide + 1.5}, {24.0 - wide - 1.5, 16.0 - wide - 1.5});
  plan.addBox({wide, wide}, {8.0, wide + 1.5});
  plan.addBox({11.0, wide}, {24.0 - wide, wide + 1.5});
  plan.addBox({24.0 - wide - 1.5, wide}, {24.0 - wide, 6.5});
  plan.addBox({24.0 - wide - 1.5, 9.0}, {24.0 - wide, 16.0 - wide});
  plan.addBox({wide, 16.0 - wide - 1.5}, {13.0, 16.0 - wide});
  plan.addBox({16.0, 16.0 - wide - 1.5}, {24.0 - wide, 16.0 - wide});
  return plan;
}

/// 24 x 18 m: round and turned pillars, cut corners, oblique partitions.
Building pillarHall(Random& random) {
  Building plan;
  plan.width = 24.0;
  plan.height = 18.0;
  plan.start = {3.0, 9.0, 0.0};
  plan.addOuterWalls(kOuterWall);
  plan.solids.push_back({{0.0, 0.0}, {3.5, 0.0}, {0.0, 4.0}});
  plan.solids.push_back({{24.0, 18.0}, {19.0, 18.0}, {24.0, 14.5}});
  plan.addWall({12.0, 0.0}, {14.5, 6.0}, 0.15);
  plan.addWall({6.0, 18.0}, {8.0, 13.8}, 0.15);
  plan.addWall({16.0, 11.0}, {21.0, 8.5}, 0.15);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const Eigen::Vector2d place(4.0 + 4.0 * column + row, 4.5 + 4.0 * row);
      if ((row + column) % 2 == 0) {
        plan.addDisc(place, 0.35);
      } else {
        plan.addTurnedBox(place, {0.7, 0.7}, random.uniform(0.0, 0.5 * M_PI));
      }
    }
  }
  return plan;
}

/// 26 x 16 m: a rotunda, curved partitions, a curved end wall.
Building gallery(Random&) {
  Building plan;
  plan.width = 26.0;
  plan.height = 16.0;
  plan.start = {2.0, 8.0, 0.0};
  plan.addOuterWalls(kOuterWall);
  for (int quarter = 0; quarter < 4; ++quarter) {  // the rotunda has a door in each quarter
    const double door = 10.0 + 90.0 * quarter;
    plan.addArcWall({9.0, 8.0}, 4.0, (door + 20.0) * kRadiansPerDegree,
                    (door + 90.0) * kRadiansPerDegree, 0.2);
  }
  plan.addDisc({9.0, 8.0}, 0.8);
  plan.addArcWall({17.0, 16.0}, 6.0, 200.0 * kRadiansPerDegree, 320.0 * kRadiansPerDegree, 0.15);
  plan.addArcWall({18.0, 0.0}, 5.0, 30.0 * kRadiansPerDegree, 130.0 * kRadiansPerDegree, 0.15);
  plan.addArcWall({17.0, 8.0}, 9.0, -48.0 * kRadiansPerDegree, 48.0 * kRadiansPerDegree, 0.2);
  return plan;
}

}  // namespace cca
