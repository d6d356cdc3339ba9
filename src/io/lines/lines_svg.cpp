// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cinttypes>
#include <cmath>

#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"

namespace cca {
namespace {

constexpr double kMargin = 0.5;              // m
constexpr double kMillimetresPerMetre = 10;  // 1 : 100
constexpr double kLegend = 0.9;              // m, height of the strip below for scale and north
constexpr const char* kInk = "#333333";

using Box = Eigen::AlignedBox2d;

Box boundingBox(const std::vector<MapLine>& lines, const std::vector<Pose2>& trajectory) {
  Box box;
  for (const MapLine& line : lines) box.extend(line.segment.start).extend(line.segment.end);
  for (const Pose2& pose : trajectory) box.extend(pose.position());
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
  const Eigen::Vector2d margin(kMargin, kMargin);
  return Box(box.min() - margin - Eigen::Vector2d(0.0, kLegend), box.max() + margin);
}

/// SVG's y axis points down the page.
std::string point(const Eigen::Vector2d& p) { return formatted("%.4f,%.4f ", p.x(), -p.y()); }

std::string svgHead(const Box& box) {
  const Eigen::Vector2d size = box.sizes();
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         formatted(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.2fmm\" height=\"%.2fmm\" "
             "viewBox=\"%.4f %.4f %.4f %.4f\">\n",
             kMillimetresPerMetre * size.x(), kMillimetresPerMetre * size.y(), box.min().x(),
             -box.max().y(), size.x(), size.y()) +
         "<title>Line map, 1 : 100, user unit 1 m</title>\n"
         "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
}

std::string scaleBar(const Box& box) {
  const double length = scaleBarLength(std::max(1.0, 0.25 * (box.sizes().x() - 2.0 * kMargin)));
  const double x = box.min().x() + kMargin, y = -box.min().y() - 0.3;
  return formatted("<g id=\"scale\" stroke=\"%s\" stroke-width=\"0.03\">\n", kInk) +
         formatted("<path d=\"M %.4f %.4f v 0.16 h %g v -0.16\"/>\n", x, y - 0.16, length) +
         formatted("<text x=\"%.4f\" y=\"%.4f\" font-size=\"0.3\" ", x + 0.08, y - 0.1) +
         formatted("font-family=\"sans-serif\" fill=\"%s\" stroke=\"none\">%g m</text>\n</g>\n",
                   kInk, length);
}

/// An arrow to true north in the lower right corner.
std::string northArrow(const Box& box, const GeoReference& place) {
  const double x = box.max().x() - kMargin, y = -box.min().y() - 0.5;
  // y points down the page: a turn of the map to the left is one of north to the right.
  return formatted("<g id=\"north\" transform=\"translate(%.4f %.4f) rotate(%.4f)\" ", x, y,
                   place.turn_deg) +
         formatted("stroke=\"%s\" stroke-width=\"0.03\">\n", kInk) +
         "<path d=\"M 0 0.35 V -0.3 M -0.1 -0.12 L 0 -0.35 L 0.1 -0.12\"/>\n" +
         formatted(
             "<text x=\"-0.32\" y=\"0.1\" font-size=\"0.3\" font-family=\"sans-serif\" "
             "fill=\"%s\" stroke=\"none\">N</text>\n</g>\n",
             kInk);
}

std::string svgArc(const Arc& arc) {
  if (arc.sweep >= 2.0 * M_PI) {
    return formatted("<circle cx=\"%.4f\" cy=\"%.4f\" r=\"%.4f\"/>\n", arc.centre.x(),
                     -arc.centre.y(), arc.radius);
  }
  const Eigen::Vector2d a = arc.at(0.0), b = arc.at(1.0);
  return formatted("<path d=\"M %.4f %.4f A %.4f %.4f 0 %d 0 %.4f %.4f\"/>\n", a.x(), -a.y(),
                   arc.radius, arc.radius, arc.sweep > M_PI ? 1 : 0, b.x(), -b.y());
}

}  // namespace

double scaleBarLength(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * (most >= 5.0 * power ? 5.0 : most >= 2.0 * power ? 2.0 : 1.0);
}

std::string linesSvg(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                     const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs,
                     const std::optional<GeoReference>& place) {
  const Box box = boundingBox(lines, trajectory);
  std::string text = svgHead(box);
  if (!trajectory.empty()) {
    text += "<polyline id=\"trajectory\" stroke=\"#d98c3f\" stroke-width=\"0.03\" points=\"";
    for (const Pose2& pose : trajectory) text += point(pose.position());
    text += "\"/>\n";
  }
  text += "<g id=\"poly_lines\" stroke=\"#1f5fa8\" stroke-width=\"0.05\">\n";
  for (const PolyLine& chain : poly_lines) {
    text += "<polyline data-line-ids=\"";
    for (const std::uint64_t id : chain.line_ids) text += std::to_string(id) + " ";
    text += "\" points=\"";
    for (const auto& vertex : chain.vertices) text += point(vertex);
    text += "\"/>\n";
  }
  text += "</g>\n<g id=\"lines\" stroke=\"#1f5fa8\" stroke-width=\"0.05\">\n";
  for (const MapLine& line : loneLines(lines, poly_lines)) {
    const auto &a = line.segment.start, &b = line.segment.end;
    text +=
        formatted("<line data-id=\"%" PRIu64 "\" data-support=\"%.1f\" ", line.id, line.support) +
        (line.kind == LineKind::kDotted ? "stroke-dasharray=\"0.15 0.1\" " : "") +
        formatted("x1=\"%.4f\" y1=\"%.4f\" x2=\"%.4f\" y2=\"%.4f\"/>\n", a.x(), -a.y(), b.x(),
                  -b.y());
  }
  text += "</g>\n<g id=\"arcs\" stroke=\"#3f9a5f\" stroke-width=\"0.02\">\n";
  for (const MapArc& arc : arcs) text += svgArc(arc.arc);
  text += "</g>\n" + scaleBar(box);
  if (place) text += northArrow(box, *place);
  return text + "</g>\n</svg>\n";
}

}  // namespace cca
