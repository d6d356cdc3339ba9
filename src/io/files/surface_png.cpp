// SPDX-License-Identifier: BSD-3-Clause
#include "surface_png.hpp"

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
