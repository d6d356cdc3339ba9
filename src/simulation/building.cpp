// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/building.hpp"

#include <algorithm>
#include <cmath>

namespace cca {

void Building::addBox(const Eigen::Vector2d& lowest, const Eigen::Vector2d& highest) {
  solids.push_back({lowest, {highest.x(), lowest.y()}, highest, {lowest.x(), highest.y()}});
}

void Building::addTurnedBox(const Eigen::Vector2d& centre, const Eigen::Vector2d& size,
                            double angle) {
  const Pose2 T_map_box{centre.x(), centre.y(), angle};
  const double x = 0.5 * size.x(), y = 0.5 * size.y();
  Polygon box;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y),
                                        Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)}) {
    box.push_back(T_map_box * corner);
  }
  solids.push_back(box);
}

void Building::addDisc(const Eigen::Vector2d& centre, double radius, int corners) {
  Polygon disc;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    disc.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  solids.push_back(disc);
  arcs.push_back({centre, radius, 0.0, 2.0 * M_PI});
}

void Building::addWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double thickness,
                       const std::vector<Opening>& openings) {
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  const Eigen::Vector2d side = 0.5 * thickness * Eigen::Vector2d(-along.y(), along.x());
  std::vector<Opening> sorted = openings;
  std::sort(sorted.begin(), sorted.end());
  sorted.emplace_back(length, length);
  double begin = 0.0;
  for (const auto& [open, close] : sorted) {
    const Eigen::Vector2d a = from + begin * along, b = from + open * along;
    if (open > begin) solids.push_back({a - side, b - side, b + side, a + side});
    begin = close;
  }
}

void Building::addArcWall(const Eigen::Vector2d& centre, double radius, double from_angle,
                          double to_angle, double thickness) {
  constexpr double kChord = 0.25;  // m, of the polygon that stands for the arc
  const int pieces =
      std::max(2, static_cast<int>(std::ceil(radius * (to_angle - from_angle) / kChord)));
  const auto at = [&](double r, int i) -> Eigen::Vector2d {
    const double angle = from_angle + (to_angle - from_angle) * i / pieces;
    return centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  Polygon wall;
  for (int i = 0; i <= pieces; ++i) wall.push_back(at(radius + 0.5 * thickness, i));
  for (int i = pieces; i >= 0; --i) wall.push_back(at(radius - 0.5 * thickness, i));
  solids.push_back(wall);
  for (const double r : {radius - 0.5 * thickness, radius + 0.5 * thickness}) {
    arcs.push_back({centre, r, from_angle, to_angle - from_angle});
  }
}

void Building::addOuterWalls(double thickness) {
  addBox({0.0, 0.0}, {width, thickness});
  addBox({0.0, height - thickness}, {width, height});
  addBox({0.0, 0.0}, {thickness, height});
  addBox({width - thickness, 0.0}, {width, height});
}

World rasterise(const Building& plan, double resolution) {
  const int width = static_cast<int>(std::lround(plan.width / resolution));
  const int height = static_cast<int>(std::lround(plan.height / resolution));
  std::vector<unsigned char> obstacle(static_cast<std::size_t>(width) * height, 0);
  for (const Polygon& solid : plan.solids) {
    const Eigen::AlignedBox2d bounds = boundsOf(solid);
    const int x0 = std::max(0, static_cast<int>(std::floor(bounds.min().x() / resolution)));
    const int y0 = std::max(0, static_cast<int>(std::floor(bounds.min().y() / resolution)));
    const int x1 = std::min(width - 1, static_cast<int>(bounds.max().x() / resolution));
    const int y1 = std::min(height - 1, static_cast<int>(bounds.max().y() / resolution));
    for (int iy = y0; iy <= y1; ++iy) {
      for (int ix = x0; ix <= x1; ++ix) {
        if (isInside(solid, resolution * Eigen::Vector2d(ix + 0.5, iy + 0.5))) {
          obstacle[static_cast<std::size_t>(iy) * width + ix] = 1;
        }
      }
    }
  }
  World world(plan.name, width, height, obstacle, resolution, {0.0, 0.0});
  world.start = plan.start;
  return world;
}

}  // namespace cca
