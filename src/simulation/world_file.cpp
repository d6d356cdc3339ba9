// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <string>

#include "cca_mrpt/simulation/world.hpp"
#include "simulation/occupancy_image.hpp"
#include "simulation/yaml_file.hpp"

namespace cca {

namespace {

/// What is not known to be free bars the way.
std::vector<unsigned char> obstaclesOf(const OccupancyImage& map) {
  std::vector<unsigned char> obstacle;
  obstacle.reserve(map.shades.size());
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      obstacle.push_back(map.occupancy(column, row) >= map.free_thresh);
    }
  }
  return obstacle;
}

bool hasFreeCell(const World& world) {
  for (int iy = 0; iy < world.height(); ++iy) {
    for (int ix = 0; ix < world.width(); ++ix) {
      if (!world.isObstacle(ix, iy)) return true;
    }
  }
  return false;
}

}  // namespace

World loadWorld(const std::string& yaml_path) {
  const YamlNode file = YamlNode::load(yaml_path);
  const OccupancyImage map = readOccupancyImage(yaml_path);
  World world(std::filesystem::path(yaml_path).stem().string(), map.columns, map.rows,
              obstaclesOf(map), map.resolution, map.origin);
  if (!hasFreeCell(world)) file.fail("image", "has no free cell within its outermost rows");
  if (file.has("start")) {
    const auto start = file.numbers("start", 3);
    world.start = Pose2{start[0], start[1], wrapAngle(start[2] * M_PI / 180.0)};
  }
  for (const auto& key : file.keys()) {
    static const std::string kKnown =
        " image resolution origin occupied_thresh free_thresh negate mode start ";
    if (kKnown.find(" " + key + " ") == std::string::npos) world.unknown_keys.push_back(key);
  }
  return world;
}

}  // namespace cca
