// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/occupancy_files.hpp"

#include <cstdio>
#include <filesystem>

#include "io/files/atomic_file.hpp"
#include "io/files/gzip_archive.hpp"
#include "simulation/occupancy_image.hpp"

namespace cca {
namespace {

/// Of an image of map_server: black, nearly white, grey.
constexpr char kOccupiedGrey = 0, kFreeGrey = static_cast<char>(254),
               kUnknownGrey = static_cast<char>(205);

char shade(float free) {
  const float occupied = 1.0F - free;
  if (occupied > kOccupiedFrom) return kOccupiedGrey;
  return occupied < kFreeBelow ? kFreeGrey : kUnknownGrey;
}

std::string pgm(const mrpt::maps::COccupancyGridMap2D& grid) {
  const int columns = static_cast<int>(grid.getSizeX()), rows = static_cast<int>(grid.getSizeY());
  std::string image = "P5\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n255\n";
  image.reserve(image.size() + grid.getSizeX() * grid.getSizeY());
  for (int row = rows - 1; row >= 0; --row) {
    for (int column = 0; column < columns; ++column) image += shade(grid.getCell(column, row));
  }
  return image;
}

std::string yaml(const mrpt::maps::COccupancyGridMap2D& grid, const Eigen::Vector2d& p_frame,
                 const std::string& image) {
  char text[512];
  std::snprintf(text, sizeof text,
                "resolution: %.6g\norigin: [%.6f, %.6f, 0.0]\n"
                "occupied_thresh: %.3f\nfree_thresh: %.3f\nnegate: 0\n",
                grid.getResolution(), p_frame.x() + grid.getXMin(), p_frame.y() + grid.getYMin(),
                kOccupiedFrom, kFreeBelow);
  return "image: " + image + "\n" + text;
}

}  // namespace

void writeOccupancyMap(const std::string& path_without_extension,
                       const mrpt::maps::COccupancyGridMap2D& grid,
                       const Eigen::Vector2d& p_frame) {
  const std::string image = path_without_extension + ".pgm";
  writeFile(image, pgm(grid));
  writeFile(path_without_extension + ".yaml",
            yaml(grid, p_frame, std::filesystem::path(image).filename().string()));
}

std::shared_ptr<mrpt::maps::COccupancyGridMap2D> readOccupancyMap(const std::string& yaml_path,
                                                                  const Eigen::Vector2d& p_frame) {
  const OccupancyImage map = readOccupancyImage(yaml_path);
  const auto left = static_cast<float>(map.origin.x() - p_frame.x()),
             low = static_cast<float>(map.origin.y() - p_frame.y()),
             side = static_cast<float>(map.resolution);
  auto grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>();
  grid->setSize(left, left + map.columns * side, low, low + map.rows * side, side);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const double occupied = map.occupancy(column, row);
      grid->setCell(column, row,
                    occupied > map.occupied_thresh ? 0.0F
                    : occupied < map.free_thresh   ? 1.0F
                                                   : 0.5F);
    }
  }
  return grid;
}

void writeGridMap(const std::string& path, const mrpt::maps::COccupancyGridMap2D& grid) {
  GzipArchive file(path);
  file.write(grid);
  file.commit();
}

}  // namespace cca
