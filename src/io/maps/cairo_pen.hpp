// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cairo/cairo.h>

#include <memory>
#include <string>

#include "io/maps/colour.hpp"

namespace cca {

using CairoSurface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using CairoPen = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

/// Draws on a surface; glyphs as they are: hinted ones depend on what the program drew before, and
/// the same map has to give the same bytes.
CairoPen penOn(cairo_surface_t* surface);

void choose(cairo_t* pen, const Colour& colour);
/// @param size  in the pen's units.
void chooseFont(cairo_t* pen, double size, bool is_bold);

/// @param of  "FILE: ", for the message.
/// @throws std::runtime_error with Cairo's reason where something could not be drawn.
void requireDrawn(cairo_t* pen, const std::string& of = "");

/// What a PNG file of a surface (CAIRO_FORMAT_RGB24) holds. Cairo's own writer squeezes three times
/// as long as drawing a map takes; this one prefers speed.
/// @throws std::runtime_error with libpng's reason.
std::string pngOf(cairo_surface_t* surface);

}  // namespace cca
