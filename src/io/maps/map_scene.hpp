// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/COpenGLScene.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "cca_mrpt/io/map_products.hpp"

namespace cca {

/// The map in 3-D for MRPT's viewers: floor grid, walls of 1 m raised on the lines, trajectory,
/// corner marks at start and end.
mrpt::opengl::COpenGLScene::Ptr makeScene(const MapProducts& products);

/// Writes makeScene() as a .3Dscene file, which SceneViewer3D opens.
/// @throws std::runtime_error naming the file and the reason.
void writeScene(const std::string& path, const MapProducts& products);

/// Draws makeScene() from above and aside, off-screen (EGL: no display is needed).
/// @param longest_side  pixels, clamped to [kSmallestPicture, kLargestSolidPicture].
/// @param shown         m, map frame, not empty: what the camera looks at; nothing: wholeView().
/// @throws std::runtime_error where it cannot be drawn or written.
void writeSolidPicture(const std::string& png_path, const MapProducts& products, int longest_side,
                       const std::optional<Eigen::AlignedBox2d>& shown = std::nullopt);

constexpr int kLargestSolidPicture = 4096;

}  // namespace cca
