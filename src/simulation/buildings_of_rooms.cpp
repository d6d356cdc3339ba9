// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "simulation/building_kinds.hpp"
#include "simulation/furniture.hpp"

namespace cca {

namespace {

/// The opening of a door in a wall along x (from x = 0) or along y.
Box doorInWallAlongX(double x, double y, double wide) {
  return Box(Eigen::Vector2d(x, y - 0.5 * kInnerWall),
             Eigen::Vector2d(x + wide, y + 0.5 * kInnerWall));
}
Box doorInWallAlongY(double x, double y, double wide) {
  return Box(Eigen::Vector2d(x - 0.5 * kInnerWall, y),
             Eigen::Vector2d(x + 0.5 * kInnerWall, y + wide));
}

/// A row of rooms between y = low and y = high, with doors to a corridor at y = corridor_wall.
/// @return  the doors.
std::vector<Box> roomRow(Building& plan, double low, double high, double corridor_wall,
                         const std::vector<double>& dividers, Random& random) {
  std::vector<Opening> openings;
  std::vector<Box> doors;
  double left = kOuterWall;
  for (std::size_t i = 0; i <= dividers.size(); ++i) {
    const bool last = i == dividers.size();
    const double right = last ? plan.width - kOuterWall : dividers[i] - 0.5 * kInnerWall;
    if (!last) plan.addWall({dividers[i], low}, {dividers[i], high}, kInnerWall);
    const double wide = onRaster(random.uniform(0.9, 1.2));
    const double door = onRaster(random.uniform(left + 0.5, right - 0.5 - wide));
    openings.emplace_back(door, door + wide);
    doors.push_back(doorInWallAlongX(door, corridor_wall, wide));
    const Room room{Box(Eigen::Vector2d(left, low), Eigen::Vector2d(right, high)), {doors.back()}};
    furnish(plan, room, random.integer(4, 8), random);
    left = right + kInnerWall;
  }
  plan.addWall({0.0, corridor_wall}, {plan.width, corridor_wall}, kInnerWall, openings);
  return doors;
}

}  // namespace

/// Two rooms of 5 x 6 m and one door.
Building twoRooms(Random&) {
  Building plan;
  plan.width = 10.0;
  plan.height = 6.0;
  plan.start = {2.0, 3.0, 0.0};
  plan.addOuterWalls(kOuterWall);
  plan.addWall({5.0, 0.0}, {5.0, 6.0}, kInnerWall, {{2.5, 3.5}});
  return plan;
}

/// 40 x 25 m: a corridor from end to end, seven rooms on either side, furniture.
Building office(Random& random) {
  Building plan;
  plan.width = 40.0;
  plan.height = 25.0;
  plan.start = {2.0, 12.5, 0.0};
  plan.addOuterWalls(kOuterWall);
  Room corridor{Box(Eigen::Vector2d(kOuterWall, 11.5), Eigen::Vector2d(40.0 - kOuterWall, 13.5)),
                {}};
  corridor.doors =
      roomRow(plan, kOuterWall, 11.40, 11.45, {5.5, 11.0, 15.5, 22.5, 28.0, 34.0}, random);
  const auto upper =
      roomRow(plan, 13.60, 25.0 - kOuterWall, 13.55, {6.5, 11.5, 18.0, 23.5, 28.5, 33.0}, random);
  corridor.doors.insert(corridor.doors.end(), upper.begin(), upper.end());
  corridor.doors.emplace_back(plan.start.position(), plan.start.position());  // stays free, too
  furnish(plan, corridor, 4, random);
  return plan;
}

/// 25 x 20 m: eight rooms, some reached only through others, and much furniture.
Building apartment(Random& random) {
  Building plan;
  plan.width = 25.0;
  plan.height = 20.0;
  plan.start = {12.0, 9.5, 0.0};
  plan.addOuterWalls(kOuterWall);
  plan.addWall({0.0, 8.0}, {25.0, 8.0}, kInnerWall, {{3.0, 3.9}, {11.0, 12.6}, {20.0, 21.0}});
  plan.addWall({8.0, 0.0}, {8.0, 8.0}, kInnerWall, {{5.0, 5.9}});
  plan.addWall({16.0, 0.0}, {16.0, 8.0}, kInnerWall);
  plan.addWall({0.0, 11.0}, {17.0, 11.0}, kInnerWall, {{2.0, 3.0}, {9.0, 10.4}, {14.0, 14.9}});
  plan.addWall({6.0, 11.0}, {6.0, 20.0}, kInnerWall);
  plan.addWall({12.0, 11.0}, {12.0, 20.0}, kInnerWall, {{6.0, 6.9}});
  plan.addWall({17.0, 8.0}, {17.0, 20.0}, kInnerWall, {{0.8, 2.2}, {8.0, 9.0}});
  plan.addWall({17.0, 14.0}, {25.0, 14.0}, kInnerWall, {{5.0, 5.9}});
  const Box w_low = doorInWallAlongX(3.0, 8.0, 0.9), m_low = doorInWallAlongX(11.0, 8.0, 1.6),
            e_low = doorInWallAlongX(20.0, 8.0, 1.0), low = doorInWallAlongY(8.0, 5.0, 0.9),
            w_up = doorInWallAlongX(2.0, 11.0, 1.0), m_up = doorInWallAlongX(9.0, 11.0, 1.4),
            n_up = doorInWallAlongX(14.0, 11.0, 0.9), up = doorInWallAlongY(12.0, 17.0, 0.9),
            hall = doorInWallAlongY(17.0, 8.8, 1.4), side = doorInWallAlongY(17.0, 16.0, 1.0),
            inner = doorInWallAlongX(22.0, 14.0, 0.9);
  const auto room = [](double x0, double y0, double x1, double y1, std::vector<Box> doors) {
    return Room{Box(Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)), std::move(doors)};
  };
  furnish(plan, room(0.2, 0.2, 7.95, 7.95, {w_low, low}), 9, random);
  furnish(plan, room(8.05, 0.2, 15.95, 7.95, {low, m_low}), 9, random);
  furnish(plan, room(16.05, 0.2, 24.8, 7.95, {e_low}), 10, random);
  furnish(plan, room(0.2, 11.05, 5.95, 19.8, {w_up}), 8, random);
  furnish(plan, room(6.05, 11.05, 11.95, 19.8, {m_up, up}), 8, random);
  furnish(plan, room(12.05, 11.05, 16.95, 19.8, {n_up, up, side}), 7, random);
  furnish(plan, room(17.05, 8.05, 24.8, 13.95, {e_low, hall, inner}), 7, random);
  furnish(plan, room(17.05, 14.05, 24.8, 19.8, {side, inner}), 7, random);
  return plan;
}

}  // namespace cca
