// SPDX-License-Identifier: BSD-3-Clause
#include <cairo-pdf.h>

#include <algorithm>
#include <cmath>

#include "io/maps/cairo_pen.hpp"
#include "io/plans/plan_files.hpp"
#include "plan_sheet.hpp"

namespace cca {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kPlanPicture = 1600.0;  // pixels of the longer side

void drawText(cairo_t* pen, const SheetShape& shape) {
  chooseFont(pen, shape.text_size, shape.is_bold);
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
  const CairoPen pen = penOn(surface);
  cairo_scale(pen.get(), scale, scale);
  cairo_set_fill_rule(pen.get(), CAIRO_FILL_RULE_EVEN_ODD);
  for (const SheetShape& shape : sheet.shapes)
    shape.text.empty() ? drawPath(pen.get(), shape) : drawText(pen.get(), shape);
  cairo_show_page(pen.get());
  cairo_surface_flush(surface);
  requireDrawn(pen.get(), path + ": ");
}

cairo_status_t appendPdf(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

std::string planPdf(const PlanSheet& sheet) {
  std::string pdf;
  {
    const CairoSurface surface(
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

std::string planPng(const PlanSheet& sheet) {
  const double scale = kPlanPicture / std::max(sheet.width, sheet.height);
  const int width = std::max(1, static_cast<int>(std::lround(scale * sheet.width)));
  const int height = std::max(1, static_cast<int>(std::lround(scale * sheet.height)));
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
                             cairo_surface_destroy);
  draw("rooms.png", surface.get(), sheet, scale);
  return pngOf(surface.get());
}

}  // namespace

NamedFiles planFiles(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place) {
  NamedFiles files = planTexts(plan, title, place);
  const PlanSheet sheet = layOutPlan(plan, title, place);
  files.emplace_back("plan.pdf", planPdf(sheet));
  files.emplace_back("rooms.png", planPng(sheet));
  return files;
}

}  // namespace cca
