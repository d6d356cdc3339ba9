// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cairo.h>

#include <string>

namespace cca {

/// What a PNG file of a surface (CAIRO_FORMAT_RGB24) holds. Cairo's own writer squeezes three times
/// as long as drawing a map takes; this one prefers speed.
/// @throws std::runtime_error with libpng's reason.
std::string pngOf(cairo_surface_t* surface);

}  // namespace cca
