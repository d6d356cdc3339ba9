// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/occupancy_files.hpp"

#include <mrpt/containers/yaml.h>
#include <mrpt/img/CImage.h>

#include <cstdio>
#include <filesystem>

#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/gzip_archive.hpp"

namespace cca {
namespace {

constexpr char kOccupied = 0, kFree = static_cast<char>(254), kUnknown = static_cast<char>(205);

char shade(float free) {
  const float occupied = 1.0F - free;
  if (occupied > kOccupiedFrom) return kOccupied;
  return occupied < kFreeBelow ? kFree : kUnknown;
}

float freeness(char shade) {
  if (shade == kUnknown) return 0.5F;
  return shade == kOccupied ? 0.0F : 1.0F;
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
  try {
    const auto file = mrpt::containers::yaml::FromFile(yaml_path);
    const auto origin = file["origin"].toStdVector<double>();
    const auto name = file["image"].as<std::string>();
    mrpt::img::CImage image;
    const auto path = std::filesystem::path(yaml_path).parent_path() / name;
    if (origin.size() < 2 || !image.loadFromFile(path.string(), 0)) return nullptr;
    const int columns = static_cast<int>(image.getWidth()),
              rows = static_cast<int>(image.getHeight());
    const auto side = file["resolution"].as<float>();
    const auto left = static_cast<float>(origin[0] - p_frame.x()),
               low = static_cast<float>(origin[1] - p_frame.y());
    auto grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>();
    grid->setSize(left, left + columns * side, low, low + rows * side, side);
    for (int row = 0; row < rows; ++row) {
      const auto* line = image.ptrLine<char>(rows - 1 - row);
      for (int column = 0; column < columns; ++column)
        grid->setCell(column, row, freeness(line[column]));
    }
    return grid;
  } catch (const std::exception&) {
    return nullptr;
  }
}

void writeGridMap(const std::string& path, const mrpt::maps::COccupancyGridMap2D& grid) {
  GzipArchive file(path);
  file.write(grid);
  file.commit();
}

}  // namespace cca
