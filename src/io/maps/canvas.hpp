// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "io/maps/cairo_pen.hpp"

namespace cca {

/// A sheet of pixels that shows a part of the map, y up. Widths and radii are in pixels.
class Canvas {
 public:
  /// @param view          m, not empty. @param longest_side  pixels.
  /// @param header        pixels kept free above the view.
  Canvas(const Eigen::AlignedBox2d& view, int longest_side, int header);

  int width() const { return width_; }
  int height() const { return height_; }
  double pixelsPerMetre() const { return pixels_per_metre_; }

  void fill(const Colour& colour);
  void polyline(const std::vector<Eigen::Vector2d>& points_map, double width, const Colour& colour);
  /// Fills what lies inside of an odd number of rings.
  void area(const std::vector<std::vector<Eigen::Vector2d>>& rings_map, const Colour& colour);
  void disc(const Eigen::Vector2d& centre_map, double radius, const Colour& colour, double rim,
            const Colour& rim_colour);
  /// An image whose lower left corner lies at a point of the map. @param argb  rows from the top.
  void image(std::vector<std::uint32_t>& argb, int columns, int rows,
             const Eigen::Vector2d& lower_left_map, double metres_per_pixel);

  /// Text and bars in pixels from the sheet's upper left corner, baseline at y.
  void text(double x, double y, double size, bool bold, const Colour& colour,
            const std::string& utf8);
  void bar(double x, double y, double width, double height, const Colour& colour);

  /// What a PNG file of the sheet holds. @throws std::runtime_error with Cairo's reason.
  std::string png() const;

 private:
  Eigen::Vector2d pixel(const Eigen::Vector2d& p_map) const;

  Eigen::AlignedBox2d view_;
  double pixels_per_metre_;
  int width_, height_, header_;
  CairoSurface surface_;
  CairoPen cairo_;
};

}  // namespace cca
