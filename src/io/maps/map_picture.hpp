// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "cca_mrpt/io/map_products.hpp"

namespace cca {

/// What a picture of a map shows, and how large.
struct PictureOptions {
  int longest_side = 1600;  ///< pixels, in [kSmallestPicture, kLargestPicture]
  bool background = true;   ///< the occupancy grid, where there is one
  bool trajectory = true;
  bool caption = true;  ///< title and numbers
  /// Of the floor plan, in the products' frame: drawn lightly under the lines.
  std::vector<PlanRoom> rooms;
  /// m, map frame: what to show; nothing: the whole map.
  std::optional<Eigen::AlignedBox2d> view;
};

constexpr int kSmallestPicture = 64, kLargestPicture = 16384;

/// Draws a map as people would show it, anti-aliased, without a display: unknown space grey, free
/// space white, the scans' end points as a soft background, rooms tinted; each poly-line in a
/// colour of its own with its vertices, single lines dark; the trajectory with start and end; a
/// scale bar. An empty map gives an empty sheet with its scale bar.
/// @return  what its PNG file holds. @throws std::runtime_error with the reason.
std::string picturePng(const MapProducts& products, const PictureOptions& options = {});

/// Writes it. @throws std::runtime_error naming the file where it cannot be written.
void writePicture(const std::string& png_path, const MapProducts& products,
                  const PictureOptions& options = {});

/// What picturePng() shows where no view is given: all lines and the trajectory, where there are
/// no lines the known part of the grid, and a margin. What has gone astray (findStrays(), by the
/// poses, or by the lines' length where there is no trajectory) is left out, for one wild pose
/// would shrink the rest to a dot.
Eigen::AlignedBox2d wholeView(const MapProducts& products);

}  // namespace cca
