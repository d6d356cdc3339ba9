// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace cca {

/// A map of ROS's map_server: a YAML file, and the image that it names.
struct OccupancyImage {
  int columns = 0, rows = 0;
  double resolution = 0.0;                           ///< m, side of a cell
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: lower left corner
  double free_thresh = 0.0, occupied_thresh = 1.0;   ///< what lies between is unknown
  bool is_negated = false;                           ///< white is occupied
  std::vector<unsigned char> shades;                 ///< row by row from the lowest; 255 is white

  /// Probability in [0, 1] that a cell is occupied, as map_server has it.
  double occupancy(int column, int row) const {
    const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column);
    const double grey = shades[cell] / 255.0;
    return is_negated ? grey : 1.0 - grey;
  }
};

/// Reads both files. Turned maps (yaw) and images of more than 64 million cells are refused.
/// @throws std::runtime_error naming file, key, the value found and what is allowed.
OccupancyImage readOccupancyImage(const std::string& yaml_path);

}  // namespace cca
