// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <string>

namespace cca {

/// Writes an image as PNG, whole or not at all.
/// @throws std::runtime_error naming the file where it cannot be written.
void writePng(const mrpt::img::CImage& image, const std::string& path);

}  // namespace cca
