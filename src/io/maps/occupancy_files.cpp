// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/occupancy_files.hpp"

#include "io/files/text.hpp"

namespace cca {
namespace {

/// Of an image of map_server: black, nearly white, grey.
constexpr char kOccupiedGrey = 0, kFreeGrey = static_cast<char>(254),
               kUnknownGrey = static_cast<char>(205);
/// Probabilities of being occupied, map_server's customary thresholds.
constexpr double kOccupiedFrom = 0.65, kFreeBelow = 0.196;

char shade(Occupancy state) {
  if (state == Occupancy::kUnknown) return kUnknownGrey;
  return state == Occupancy::kFree ? kFreeGrey : kOccupiedGrey;
}

}  // namespace

std::string occupancyPgm(const OccupancyRaster& grid) {
  std::string image =
      "P5\n" + std::to_string(grid.columns) + " " + std::to_string(grid.rows) + "\n255\n";
  image.reserve(image.size() + grid.values.size());
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) image += shade(grid[{column, row}]);
  }
  return image;
}

std::string occupancyYaml(const OccupancyRaster& grid, const std::string& image) {
  return "image: " + image + "\n" +
         formatted(
             "resolution: %.6g\norigin: [%.6f, %.6f, 0.0]\n"
             "occupied_thresh: %.3f\nfree_thresh: %.3f\nnegate: 0\n",
             grid.resolution, grid.origin.x(), grid.origin.y(), kOccupiedFrom, kFreeBelow);
}

OccupancyRaster asWritten(OccupancyRaster grid, const Eigen::Vector2d& p_frame) {
  grid.origin = (1e6 * (p_frame + grid.origin)).array().round().matrix() / 1e6;
  return grid;
}

}  // namespace cca
