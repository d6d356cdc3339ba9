// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/occupancy_image.hpp"

#include <mrpt/img/CImage.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "simulation/yaml_file.hpp"

namespace cca {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestImage = 64e6;  // cells; 8000 x 8000: 400 x 400 m at 5 cm

/// Width * height of a PNG from its header, so that a monster is refused before it is unpacked;
/// 0 for every other kind of file.
double pngCells(const fs::path& path) {
  unsigned char head[24] = {};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(head), sizeof head)) return 0.0;
  if (head[0] != 0x89 || head[1] != 'P' || head[2] != 'N' || head[3] != 'G') return 0.0;
  const auto number = [&head](int at) {
    return head[at] * 16777216.0 + head[at + 1] * 65536.0 + head[at + 2] * 256.0 + head[at + 3];
  };
  return number(16) * number(20);
}

/// The value of white that a PGM's header tells; 255 for every other kind of file.
int pgmWhite(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic, comment;
  int number = 255;
  if (!(file >> magic) || (magic != "P2" && magic != "P5")) return number;
  for (int i = 0; i < 3; ++i) {  // width, height, white
    while ((file >> std::ws).peek() == '#') std::getline(file, comment);
    if (!(file >> number)) return 255;
  }
  return number;
}

mrpt::img::CImage loadImage(const YamlNode& file, const std::string& yaml_path) {
  const fs::path path = fs::path(yaml_path).parent_path() / file.text("image");
  if (!fs::is_regular_file(path)) {
    file.fail("image", path.string() + (fs::exists(path) ? " is no file" : " does not exist"));
  }
  const auto refuse_size = [&](double cells) {
    if (cells > kLargestImage) {
      file.fail("image", path.string() + " has more than 64 million cells");
    }
  };
  refuse_size(pngCells(path));
  // The image library takes the values of a byte as they are, whatever white is.
  const int white = pgmWhite(path);
  if (white < 255) {
    file.fail("image",
              path.string() + " has " + std::to_string(white) + " for white, allowed is 255");
  }
  mrpt::img::CImage image;
  bool loaded = false;
  try {
    loaded = image.loadFromFile(path.string(), 0);
  } catch (const std::exception&) {
  }
  if (!loaded) file.fail("image", path.string() + " is no readable image");
  refuse_size(static_cast<double>(image.getWidth()) * static_cast<double>(image.getHeight()));
  return image;
}

/// Twice as far as a pose may lie (1e7 m): a map reaches beyond its poses.
Eigen::Vector2d readOrigin(const YamlNode& file) {
  const auto origin = file.numbers("origin", 3);
  for (double value : origin) {
    if (std::abs(value) > 2e7) file.fail("origin", "is out of range, allowed is -2e7 to 2e7");
  }
  if (origin[2] != 0.0) file.fail("origin", "a turned map is not supported, yaw must be 0");
  return {origin[0], origin[1]};
}

}  // namespace

OccupancyImage readOccupancyImage(const std::string& yaml_path) {
  const YamlNode file = YamlNode::load(yaml_path);
  OccupancyImage map;
  map.resolution = file.number("resolution", 0.001, 10.0);
  map.origin = readOrigin(file);
  map.free_thresh = file.number("free_thresh", 0.0, 1.0);
  map.occupied_thresh = file.number("occupied_thresh", map.free_thresh, 1.0);
  map.is_negated = file.choice("negate", {"0", "1", "false", "true"}, "0") != "0" &&
                   file.text("negate") != "false";
  file.choice("mode", {"trinary", "scale"}, "trinary");
  const mrpt::img::CImage image = loadImage(file, yaml_path);
  map.columns = static_cast<int>(image.getWidth());
  map.rows = static_cast<int>(image.getHeight());
  map.shades.reserve(image.getWidth() * image.getHeight());
  for (int row = map.rows - 1; row >= 0; --row) {  // an image begins at the top, a grid at y = 0
    const auto* line = image.ptrLine<unsigned char>(row);
    map.shades.insert(map.shades.end(), line, line + map.columns);
  }
  return map;
}

}  // namespace cca
