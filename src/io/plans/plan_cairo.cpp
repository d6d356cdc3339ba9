// SPDX-License-Identifier: BSD-3-Clause
#include <cairo-pdf.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "io/files/surface_png.hpp"
#include "io/logs/unhinted_text.hpp"
#include "io/plans/plan_files.hpp"
#include "io/plans/plan_formats.hpp"
#include "plan_sheet.hpp"

namespace cca {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Pen = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

constexpr double kPointsPerMm = 72.0 / 25.4;

void choose(cairo_t* pen, const Colour& colour) {
  cairo_set_source_rgba(pen, colour.red, colour.green, colour.blue, colour.alpha);
}

void drawText(cairo_t* pen, const SheetShape& shape) {
  cairo_select_font_face(pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         shape.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, shape.text_size);
  cairo_text_extents_t extents;
  cairo_text_extents(pen, shape.text.c_str(), &extents);
  const Eigen::Vector2d& p = shape.rings.front().front();
  choose(pen, shape.fill);
  cairo_move_to(pen, p.x() - (shape.is_left_aligned ? 0.0 : 0.5 * extents.x_advance), p.y());
  cairo_show_text(pen, shape.text.c_str());
  cairo_new_path(pen);
}

void drawPath(cairo_t* pen, const SheetShape& shape) {
  for (const Polygon& ring : shape.rings) {
    cairo_new_sub_path(pen);
    for (const auto& p : ring) cairo_line_to(pen, p.x(), p.y());
    if (shape.is_closed) cairo_close_path(pen);
  }
  if (shape.is_closed && shape.fill.alpha > 0.0) {
    choose(pen, shape.fill);
    cairo_fill_preserve(pen);
  }
  if (shape.stroke_width > 0.0) {
    const double dashes[] = {1.2, 0.8};
    cairo_set_dash(pen, dashes, shape.is_dashed ? 2 : 0, 0.0);
    choose(pen, shape.stroke);
    cairo_set_line_width(pen, shape.stroke_width);
    cairo_stroke_preserve(pen);
  }
  cairo_new_path(pen);
}

/// @param scale  units of the surface in a millimetre.
void draw(const std::string& path, cairo_surface_t* surface, const PlanSheet& sheet, double scale) {
  const Pen pen(cairo_create(surface), cairo_destroy);
  cairo_scale(pen.get(), scale, scale);
  drawUnhinted(pen.get());
  cairo_set_fill_rule(pen.get(), CAIRO_FILL_RULE_EVEN_ODD);
  for (const SheetShape& shape : sheet.shapes)
    shape.text.empty() ? drawPath(pen.get(), shape) : drawText(pen.get(), shape);
  cairo_show_page(pen.get());
  cairo_surface_flush(surface);
  const cairo_status_t status = cairo_status(pen.get());
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(path + ": cannot be drawn: " + cairo_status_to_string(status));
}

cairo_status_t appendPdf(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string planPdf(const FloorPlan& plan, const std::string& title,
                    const std::optional<GeoReference>& place) {
  const PlanSheet sheet = layOutPlan(plan, title, place);
  std::string pdf;
  {
    const Surface surface(
        cairo_pdf_surface_create_for_stream(appendPdf, &pdf, kPointsPerMm * sheet.width,
                                            kPointsPerMm * sheet.height),
        cairo_surface_destroy);
    // No date: the same map gives the same bytes.
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    draw("plan.pdf", surface.get(), sheet, kPointsPerMm);
    cairo_surface_finish(surface.get());
  }
  return pdf;
}

std::string planPng(const FloorPlan& plan, const std::string& title,
                    const std::optional<GeoReference>& place, int longest_side) {
  const PlanSheet sheet = layOutPlan(plan, title, place);
  const double scale = longest_side / std::max(sheet.width, sheet.height);
  const int width = std::max(1, static_cast<int>(std::lround(scale * sheet.width)));
  const int height = std::max(1, static_cast<int>(std::lround(scale * sheet.height)));
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
                        cairo_surface_destroy);
  draw("rooms.png", surface.get(), sheet, scale);
  return pngOf(surface.get());
}

NamedFiles planFiles(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place) {
  NamedFiles files = planTexts(plan, title, place);
  files.emplace_back("plan.pdf", planPdf(plan, title, place));
  files.emplace_back("rooms.png", planPng(plan, title, place));
  return files;
}

}  // namespace cca
