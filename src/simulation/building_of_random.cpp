// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "simulation/building_kinds.hpp"
#include "simulation/furniture.hpp"

namespace cca {

namespace {

constexpr double kSmallest = 3.0;     // m, side of a room
constexpr double kLargest = 8.0;      // m, a longer side is always divided
constexpr double kBesideDoor = 0.3;   // m, from a wall's end to a door
constexpr double kPost = 0.05;        // m, side of a post in a door
constexpr double kStartsFree = 0.5;   // m, around the robot's start
constexpr double kResolution = 0.05;  // m, to see where the robot gets to

/// Divides a floor by walls with a door each (or by a corridor with two), again and again: what
/// was one region stays one.
class Divider {
 public:
  /// Doors are `narrowest` to `widest` m wide.
  Divider(Building& plan, Random& random, double narrowest, double widest)
      : plan_(plan), random_(random), narrowest_(narrowest), widest_(widest) {
    divide(Box(Eigen::Vector2d(kOuterWall, kOuterWall),
               Eigen::Vector2d(plan.width - kOuterWall, plan.height - kOuterWall)));
  }

  const std::vector<Box>& rooms() const { return rooms_; }
  const std::vector<Box>& doors() const { return doors_; }

 private:
  void divide(const Box& floor) {
    const int axis = floor.sizes().x() > floor.sizes().y() ? 0 : 1;  // across the longer side
    const double side = floor.sizes()[axis];
    const bool corridor = side > 3.0 * kSmallest && random_.uniform() < 0.5;
    const double wide = corridor ? onRaster(random_.uniform(1.5, 2.2)) : 0.0;
    const double between = kInnerWall * (corridor ? 2.0 : 1.0) + wide;
    const double slack = side - between - 2.0 * kSmallest;
    const bool small = side < kLargest && random_.uniform() < 0.3;
    if (slack < 0.0 || small) {
      rooms_.push_back(floor);
      return;
    }
    for (int tries = 0; tries < 20; ++tries) {
      const double at = floor.min()[axis] + kSmallest + onRaster(random_.uniform(0.0, slack));
      if (!clearOfDoors(floor, axis, at, between)) continue;
      Box low = floor, high = floor;
      low.max()[axis] = at;
      high.min()[axis] = at + between;
      addWall(floor, axis, at + 0.5 * kInnerWall);
      if (corridor) addWall(floor, axis, at + between - 0.5 * kInnerWall);
      divide(low);
      divide(high);
      return;
    }
    rooms_.push_back(floor);
  }

  /// Whether no door lies where the ends of a wall would come.
  bool clearOfDoors(const Box& floor, int axis, double at, double between) const {
    Box wall = floor;
    wall.min()[axis] = at - kBesideDoor;
    wall.max()[axis] = at + between + kBesideDoor;
    wall.min()[1 - axis] -= kOuterWall;
    wall.max()[1 - axis] += kOuterWall;
    return std::none_of(doors_.begin(), doors_.end(),
                        [&wall](const Box& door) { return wall.intersects(door); });
  }

  void addWall(const Box& floor, int axis, double centre) {
    Eigen::Vector2d from = floor.min(), to = floor.max();
    from[axis] = to[axis] = centre;
    const double length = floor.sizes()[1 - axis];
    const double wide = onRaster(random_.uniform(narrowest_, widest_));
    const double open = onRaster(random_.uniform(kBesideDoor, length - wide - kBesideDoor));
    plan_.addWall(from, to, kInnerWall, {{open, open + wide}});
    Box door;
    door.min()[axis] = centre - 0.5 * kInnerWall;
    door.max()[axis] = centre + 0.5 * kInnerWall;
    door.min()[1 - axis] = floor.min()[1 - axis] + open;
    door.max()[1 - axis] = door.min()[1 - axis] + wide;
    doors_.push_back(door);
  }

  Building& plan_;
  Random& random_;
  double narrowest_, widest_;
  std::vector<Box> rooms_, doors_;
};

/// Outer walls around a floor that is `lowest` to `highest` m wide and high.
Building emptyFloor(const Eigen::Vector2d& lowest, const Eigen::Vector2d& highest, Random& random) {
  Building plan;
  plan.width = onRaster(random.uniform(lowest.x(), highest.x()));
  plan.height = onRaster(random.uniform(lowest.y(), highest.y()));
  plan.addOuterWalls(kOuterWall);
  return plan;
}

/// Fills rooms with things, except around the start.
Building crowd(Building plan, const Divider& divider, const Eigen::Vector2d& start, Random random) {
  const Eigen::Vector2d aside(kStartsFree, kStartsFree);
  plan.start = {start.x(), start.y(), 0.0};
  for (const Box& floor : divider.rooms()) {
    const int count = static_cast<int>(floor.volume() * random.uniform(0.12, 0.4));
    clutter(plan, floor, Box(start - aside, start + aside), count, random);
  }
  for (const Box& door : divider.doors()) {
    const int posts = random.integer(1, 2);
    if (random.uniform() >= 1.0 / 7.0) continue;
    const int axis = door.sizes().x() > door.sizes().y() ? 0 : 1;
    for (int i = 1; i <= posts; ++i) {
      Eigen::Vector2d post = door.center();
      post[axis] += (i / (posts + 1.0) - 0.5) * door.sizes()[axis];
      plan.addTurnedBox(post, {kPost, kPost}, 0.0);
    }
  }
  return plan;
}

}  // namespace

/// 16 to 32 by 12 to 24 m of rooms and corridors, furnished.
Building randomBuilding(Random& random) {
  Building plan = emptyFloor({16.0, 12.0}, {32.0, 24.0}, random);
  const Divider divider(plan, random, 0.9, 1.4);
  for (const Box& floor : divider.rooms()) {
    Room room{floor, divider.doors()};
    if (&floor == &divider.rooms().front()) {  // the robot's place stays free
      plan.start = {floor.center().x(), floor.center().y(), 0.0};
      room.doors.emplace_back(floor.center(), floor.center());
    }
    furnish(plan, room, random.integer(1, 2 + static_cast<int>(floor.volume() / 7.0)), random);
  }
  return plan;
}

/// 14 to 30 by 10 to 20 m of rooms that are full of things: legs of chairs and tables, gaps too
/// narrow for a robot, and posts in every seventh door. Much of it can only be looked into; but the
/// start is in the first room from which the robot gets to most places where it could stand.
Building crowdedBuilding(Random& random) {
  Building empty = emptyFloor({14.0, 10.0}, {30.0, 20.0}, random), best;
  const Divider divider(empty, random, 0.7, 1.1);
  double most = 0.0;
  for (const Box& room : divider.rooms()) {
    Building plan = crowd(empty, divider, room.center(), random);
    const double share =
        shareReached(rasterise(plan, kResolution), room.center(), RobotParameters{}.radius);
    if (share <= most) continue;
    most = share;
    best = std::move(plan);
    if (most > 0.5) break;
  }
  return best;
}

}  // namespace cca
