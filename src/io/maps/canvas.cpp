// SPDX-License-Identifier: BSD-3-Clause
#include "canvas.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kSmallestScale = 0.01;

int pixels(double metres, double pixels_per_metre) {
  return std::max(1, static_cast<int>(std::lround(metres * pixels_per_metre)));
}

}  // namespace

Canvas::Canvas(const Eigen::AlignedBox2d& view, int longest_side, int header)
    : view_(view),
      pixels_per_metre_(longest_side / view.sizes().maxCoeff()),
      width_(pixels(view.sizes().x(), pixels_per_metre_)),
      height_(pixels(view.sizes().y(), pixels_per_metre_) + header),
      header_(header),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_),
               cairo_surface_destroy),
      cairo_(penOn(surface_.get())) {
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
}

Eigen::Vector2d Canvas::pixel(const Eigen::Vector2d& p_map) const {
  return {(p_map.x() - view_.min().x()) * pixels_per_metre_,
          header_ + (view_.max().y() - p_map.y()) * pixels_per_metre_};
}

void Canvas::fill(const Colour& with) {
  choose(cairo_.get(), with);
  cairo_paint(cairo_.get());
}

void Canvas::polyline(const std::vector<Eigen::Vector2d>& points_map, double width,
                      const Colour& with) {
  for (const auto& p_map : points_map) {
    const Eigen::Vector2d p = pixel(p_map);
    cairo_line_to(cairo_.get(), p.x(), p.y());
  }
  choose(cairo_.get(), with);
  cairo_set_line_width(cairo_.get(), width);
  cairo_stroke(cairo_.get());
}

void Canvas::area(const std::vector<std::vector<Eigen::Vector2d>>& rings_map, const Colour& with) {
  for (const auto& ring : rings_map) {
    cairo_new_sub_path(cairo_.get());
    for (const auto& p_map : ring) {
      const Eigen::Vector2d p = pixel(p_map);
      cairo_line_to(cairo_.get(), p.x(), p.y());
    }
    cairo_close_path(cairo_.get());
  }
  choose(cairo_.get(), with);
  cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(cairo_.get());
}

void Canvas::disc(const Eigen::Vector2d& centre_map, double radius, const Colour& with, double rim,
                  const Colour& rim_colour) {
  const Eigen::Vector2d centre = pixel(centre_map);
  cairo_new_sub_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x(), centre.y(), radius, 0.0, 2.0 * M_PI);
  choose(cairo_.get(), with);
  cairo_fill_preserve(cairo_.get());
  choose(cairo_.get(), rim_colour);
  cairo_set_line_width(cairo_.get(), rim);
  cairo_stroke(cairo_.get());
}

void Canvas::image(std::vector<std::uint32_t>& argb, int columns, int rows,
                   const Eigen::Vector2d& lower_left_map, double metres_per_pixel) {
  const CairoSurface picture(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(argb.data()),
                                          CAIRO_FORMAT_RGB24, columns, rows, 4 * columns),
      cairo_surface_destroy);
  const Eigen::Vector2d corner =
      pixel(lower_left_map + Eigen::Vector2d(0.0, rows * metres_per_pixel));
  const double scale = metres_per_pixel * pixels_per_metre_;
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), corner.x(), corner.y());
  cairo_scale(cairo_.get(), scale, scale);
  cairo_set_source_surface(cairo_.get(), picture.get(), 0.0, 0.0);
  // The good filter looks at every cell of a pixel's, and gives up the sheet where these are many.
  cairo_pattern_set_filter(cairo_get_source(cairo_.get()),
                           scale < kSmallestScale ? CAIRO_FILTER_FAST : CAIRO_FILTER_GOOD);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
}

void Canvas::text(double x, double y, double size, bool bold, const Colour& with,
                  const std::string& utf8) {
  chooseFont(cairo_.get(), size, bold);
  choose(cairo_.get(), with);
  cairo_move_to(cairo_.get(), x, y);
  cairo_show_text(cairo_.get(), utf8.c_str());
  cairo_new_path(cairo_.get());
}

void Canvas::bar(double x, double y, double width, double height, const Colour& with) {
  cairo_rectangle(cairo_.get(), x, y, width, height);
  choose(cairo_.get(), with);
  cairo_fill(cairo_.get());
}

std::string Canvas::png() const {
  requireDrawn(cairo_.get());
  return pngOf(surface_.get());
}

}  // namespace cca
