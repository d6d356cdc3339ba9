// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/text.hpp"
#include "io/plans/plan_formats.hpp"
#include "plan_sheet.hpp"

namespace cca {
namespace {

std::string inSvg(const Colour& colour) {
  return colour.alpha > 0.0 ? formatted("#%06x", rgb(colour)) : "none";
}

std::string decimal(double value) { return formatted("%.3f", value); }

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      safe += c;
  }
  return safe;
}

std::string textElement(const SheetShape& shape) {
  const Eigen::Vector2d& p = shape.rings.front().front();
  return "<text x=\"" + decimal(p.x()) + "\" y=\"" + decimal(p.y()) + "\" font-size=\"" +
         decimal(shape.text_size) + "\" fill=\"" + inSvg(shape.fill) + "\"" +
         (shape.is_bold ? " font-weight=\"bold\"" : "") +
         (shape.is_left_aligned ? "" : " text-anchor=\"middle\"") + ">" + escaped(shape.text) +
         "</text>\n";
}

std::string pathElement(const SheetShape& shape) {
  std::string d;
  for (const Polygon& ring : shape.rings) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      d += (k ? "L" : "M") + decimal(ring[k].x()) + " " + decimal(ring[k].y());
    if (shape.is_closed) d += "Z";
  }
  std::string element =
      "<path d=\"" + d + "\" fill=\"" + (shape.is_closed ? inSvg(shape.fill) : "none") + "\"";
  if (shape.stroke_width > 0.0) {
    element += " stroke=\"" + inSvg(shape.stroke) + "\" stroke-width=\"" +
               decimal(shape.stroke_width) + "\"";
  }
  if (shape.is_dashed) element += " stroke-dasharray=\"1.2 0.8\"";
  if (shape.title.empty()) return element + "/>\n";
  return element + "><title>" + escaped(shape.title) + "</title></path>\n";
}

}  // namespace

std::string planSvg(const FloorPlan& plan, const std::string& title,
                    const std::optional<GeoReference>& place) {
  const PlanSheet sheet = layOutPlan(plan, title, place);
  const std::string width = decimal(sheet.width), height = decimal(sheet.height);
  const double metres = 0.001 * sheet.scale;
  const std::string place_on_map = formatted(
      "translate(%.6f %.6f) scale(%.3f)", sheet.p_map_corner.x(), -sheet.p_map_corner.y(), metres);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"" + std::string(kPlanSvgId) +
                    "\" " + kPlanSvgPlace + "=\"" + place_on_map + "\" width=\"" + width +
                    "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height +
                    "\" font-family=\"sans-serif\" fill-rule=\"evenodd\">\n";
  std::string layer;
  for (const SheetShape& shape : sheet.shapes) {
    if (shape.layer != layer) {
      svg += (layer.empty() ? "<g id=\"" : "</g>\n<g id=\"") + shape.layer + "\">\n";
      layer = shape.layer;
    }
    svg += shape.text.empty() ? pathElement(shape) : textElement(shape);
  }
  return svg + "</g>\n</svg>\n";
}

}  // namespace cca
