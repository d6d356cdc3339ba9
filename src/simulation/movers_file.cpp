// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cca_mrpt/simulation/mover.hpp"
#include "simulation/yaml_file.hpp"

namespace cca {

namespace {

constexpr double kFarthest = 1e6;     // m
constexpr double kCornerRoom = 0.05;  // m, a way-point is passed this far from it

void readShape(const YamlNode& entry, Body& body) {
  body.shape = entry.choice("shape", {"disc", "box"}, "disc") == "disc" ? Body::Shape::kDisc
                                                                        : Body::Shape::kBox;
  if (body.shape == Body::Shape::kDisc) {
    if (entry.has("size")) entry.fail("size", "belongs to shape: box");
    const double radius = entry.number("radius", 0.05, 5.0, 0.25);
    body.half_size = {radius, radius};
    return;
  }
  if (entry.has("radius")) entry.fail("radius", "belongs to shape: disc");
  const auto size = entry.numbers("size", 2);
  for (double side : size) {
    if (side < 0.1 || side > 10.0)
      entry.fail("size", "a side is out of range, allowed is 0.1 to 10 m");
  }
  body.half_size = {0.5 * size[0], 0.5 * size[1]};
}

Eigen::Vector2d place(const YamlNode& entry, const std::string& key, const std::vector<double>& p) {
  if (std::abs(p[0]) > kFarthest || std::abs(p[1]) > kFarthest) entry.fail(key, "is out of range");
  return {p[0], p[1]};
}

void requireFree(const YamlNode& entry, const std::string& key, const World& world,
                 const Eigen::Vector2d& p, double radius) {
  constexpr double kFarther = 0.01;  // m: at its limit a clearance is rounded
  if (world.clearance(p, radius + kFarther) >= radius) return;
  char text[120];
  std::snprintf(text, sizeof text, "comes into a wall at %.2f, %.2f m", p.x(), p.y());
  entry.fail(key, text);
}

void requireFreeLeg(const YamlNode& entry, const World& world, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to, double radius) {
  const double length = (to - from).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / 0.02)));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = from + (to - from) * (static_cast<double>(i) / steps);
    requireFree(entry, "way_points", world, p, radius + kCornerRoom);
  }
}

Mover readMover(const YamlNode& entry, const World& world) {
  entry.allowOnly({"shape", "radius", "size", "speed", "gap", "way_points", "loop", "start"});
  Mover mover;
  readShape(entry, mover.body);
  mover.speed = entry.number("speed", 0.01, 3.0, mover.speed);
  mover.gap = entry.number("gap", 0.0, 5.0, mover.gap);
  mover.loop = entry.choice("loop", {"true", "false"}, "false") == "true";
  const double radius = mover.body.radius();
  Eigen::Vector2d start;
  if (entry.has("way_points")) {
    if (entry.has("start")) entry.fail("start", "belongs to a random walk, without way_points");
    for (const auto& p : entry.rows("way_points", 2)) {
      mover.way_points.push_back(place(entry, "way_points", p));
    }
    const auto& way = mover.way_points;
    if (way.size() < 2) entry.fail("way_points", "must be at least two");
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      requireFreeLeg(entry, world, way[i], way[i + 1], radius);
    }
    if (mover.loop) requireFreeLeg(entry, world, way.back(), way.front(), radius);
    start = way.front();
  } else {
    if (entry.has("loop")) entry.fail("loop", "belongs to way_points");
    start = place(entry, "start", entry.numbers("start", 2));
    requireFree(entry, "start", world, start, radius);
  }
  mover.body.T_map_body = {start.x(), start.y(), 0.0};
  return mover;
}

}  // namespace

std::vector<Mover> loadMovers(const std::string& yaml_path, const World& world) {
  const YamlNode file = YamlNode::load(yaml_path);
  file.allowOnly({"movers"});
  if (!file.has("movers")) file.fail("movers", "is missing");
  std::vector<Mover> movers;
  for (const YamlNode& entry : file.list("movers")) movers.push_back(readMover(entry, world));
  return movers;
}

}  // namespace cca
