// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/cairo_pen.hpp"

#include <png.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace cca {
namespace {

constexpr std::size_t kChannels = 3;  // red, green, blue

/// Cairo keeps a pixel as a number, 0x00RRGGBB in the machine's order of bytes.
std::vector<std::uint8_t> rgbOf(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const int width = cairo_image_surface_get_width(surface);
  const int height = cairo_image_surface_get_height(surface);
  const unsigned char* const data = cairo_image_surface_get_data(surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
  std::vector<std::uint8_t> rgb;
  rgb.reserve(kChannels * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    const auto* pixel = reinterpret_cast<const std::uint32_t*>(data + row * stride);
    for (int column = 0; column < width; ++column, ++pixel) {
      for (const int shift : {16, 8, 0}) rgb.push_back(static_cast<std::uint8_t>(*pixel >> shift));
    }
  }
  return rgb;
}

}  // namespace

CairoPen penOn(cairo_surface_t* surface) {
  CairoPen pen(cairo_create(surface), cairo_destroy);
  const std::unique_ptr<cairo_font_options_t, void (*)(cairo_font_options_t*)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(pen.get(), options.get());
  return pen;
}

void choose(cairo_t* pen, const Colour& colour) {
  cairo_set_source_rgba(pen, colour.red, colour.green, colour.blue, colour.alpha);
}

void chooseFont(cairo_t* pen, double size, bool is_bold) {
  cairo_select_font_face(pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, size);
}

void requireDrawn(cairo_t* pen, const std::string& of) {
  const cairo_status_t status = cairo_status(pen);
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(of + "cannot be drawn: " + cairo_status_to_string(status));
}

std::string pngOf(cairo_surface_t* surface) {
  const std::vector<std::uint8_t> rgb = rgbOf(surface);
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(cairo_image_surface_get_width(surface));
  image.height = static_cast<png_uint_32>(cairo_image_surface_get_height(surface));
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string png(size, '\0');
  if (png_image_write_to_memory(&image, png.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("no PNG can be made of it: ") + image.message);
  }
  png.resize(size);
  return png;
}

}  // namespace cca
