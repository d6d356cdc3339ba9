// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "canvas.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/stray_places.hpp"
#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"

namespace cca {
namespace {

using Box = Eigen::AlignedBox2d;

constexpr double kMarginOfPicture = 1.0;  // m around the map
constexpr double kSmallestView = 2.0;     // m
constexpr int kHeader = 64;               // pixels of a sheet of 1600
constexpr double kRoomOpacity = 0.1;
constexpr double kThinnest = 0.5;  // of the strokes on a sheet of 1600 pixels

constexpr Colour kUnknown{0.906, 0.922, 0.933}, kFree{1.0, 1.0, 1.0}, kHit{0.55, 0.62, 0.67};
// On paper: a contrast of 14 and 5, for which WCAG 2.1 asks 7 (AAA) and 4.5 (AA).
constexpr Colour kDarkInk{0.13, 0.17, 0.21}, kSoftInk{0.38, 0.44, 0.49}, kPaper{1.0, 1.0, 1.0};
constexpr Colour kTrajectory{0.93, 0.55, 0.14, 0.85};
constexpr Colour kStart{0.16, 0.63, 0.29}, kEnd{0.84, 0.15, 0.16};
/// Dark enough for white paper, and told apart by most colour-blind people.
constexpr std::array<Colour, 6> kPalette{{{0.00, 0.33, 0.64},
                                          {0.73, 0.21, 0.13},
                                          {0.00, 0.50, 0.42},
                                          {0.48, 0.24, 0.60},
                                          {0.55, 0.40, 0.05},
                                          {0.10, 0.53, 0.75}}};

constexpr int kLargestImage = 32767;  // pixels a side, of an image of cairo's

std::uint32_t cellColour(Occupancy state) {
  if (state == Occupancy::kUnknown) return rgb(kUnknown);
  return rgb(state == Occupancy::kFree ? kFree : kHit);
}

void drawBackground(Canvas& canvas, const OccupancyRaster& grid, const Box& view) {
  const Cell first = grid.cellOf(view.min()), last = grid.cellOf(view.max());
  const int left = std::clamp(first.x, 0, grid.columns);
  const int right = std::clamp(last.x + 1, 0, grid.columns);
  const int low = std::clamp(first.y, 0, grid.rows);
  const int high = std::clamp(last.y + 1, 0, grid.rows);
  if (right <= left || high <= low) return;
  // Of so many cells, all that a sheet of kLargestPicture can show are still there.
  const int step = (std::max(right - left, high - low) - 1) / kLargestImage + 1;
  const int columns = (right - left - 1) / step + 1, rows = (high - low - 1) / step + 1;
  std::vector<std::uint32_t> argb(static_cast<std::size_t>(columns) *
                                  static_cast<std::size_t>(rows));
  std::size_t at = 0;
  for (int row = high - 1; row >= low; row -= step) {
    for (int column = left; column < right; column += step)
      argb[at++] = cellColour(grid[{column, row}]);
  }
  canvas.image(argb, columns, rows, grid.inMetres({left, high - rows * step}),
               step * grid.resolution);
}

/// So lightly that cells and lines are seen as before.
void drawRooms(Canvas& canvas, const std::vector<PlanRoom>& rooms) {
  std::size_t next = 0;
  for (const PlanRoom& room : rooms) {
    std::vector<Polygon> rings{room.outline};
    rings.insert(rings.end(), room.holes.begin(), room.holes.end());
    Colour colour = kPalette[next++ % kPalette.size()];
    colour.alpha = kRoomOpacity;
    canvas.area(rings, colour);
  }
}

void drawLines(Canvas& canvas, const MapProducts& products, double unit) {
  for (const MapLine& line : loneLines(products.lines, products.poly_lines)) {
    const LineSegment& s = line.segment;
    if (line.kind == LineKind::kWall) {
      canvas.polyline({s.start, s.end}, 2.2 * unit, kDarkInk);
      continue;
    }
    const double dash = 5.0 * unit / canvas.pixelsPerMetre();
    for (double t = 0.0; t < s.length(); t += 2.0 * dash) {
      const Eigen::Vector2d from = s.start + t * s.direction();
      canvas.polyline({from, from + std::min(dash, s.length() - t) * s.direction()}, 2.2 * unit,
                      kDarkInk);
    }
  }
  std::size_t next = 0;
  for (const PolyLine& chain : products.poly_lines) {
    const Colour& colour = kPalette[next++ % kPalette.size()];
    canvas.polyline(chain.vertices, 2.6 * unit, colour);
    for (const auto& vertex : chain.vertices)
      canvas.disc(vertex, 2.3 * unit, kPaper, 1.3 * unit, colour);
  }
}

void drawTrajectory(Canvas& canvas, const std::vector<Pose2>& trajectory, double unit) {
  if (trajectory.empty()) return;
  std::vector<Eigen::Vector2d> path;
  for (const Pose2& pose : trajectory) path.push_back(pose.position());
  canvas.polyline(path, 1.3 * unit, kTrajectory);
}

void drawEnds(Canvas& canvas, const std::vector<Pose2>& trajectory, double unit) {
  if (trajectory.empty()) return;
  const Pose2& last = trajectory.back();
  const double nose = 14.0 * unit / canvas.pixelsPerMetre();
  canvas.disc(trajectory.front().position(), 6.0 * unit, kStart, 1.5 * unit, kPaper);
  canvas.polyline({last.position(), last.position() + nose * last.heading()}, 2.5 * unit, kEnd);
  canvas.disc(last.position(), 6.0 * unit, kEnd, 1.5 * unit, kPaper);
}

/// Beside the caption; on a sheet without one, in the lower left corner.
void drawScaleBar(Canvas& canvas, bool beside_caption, double unit) {
  const double metres = scaleBarLength(0.25 * canvas.width() / canvas.pixelsPerMetre());
  const double length = metres * canvas.pixelsPerMetre();
  const double x = beside_caption ? canvas.width() - length - 16.0 * unit : 16.0 * unit;
  const double y = (beside_caption ? kHeader * unit : canvas.height()) - 18.0 * unit;
  canvas.bar(x - 8.0 * unit, y - 24.0 * unit, length + 16.0 * unit, 36.0 * unit, {1, 1, 1, 0.8});
  for (int part = 0; part < 4; ++part) {
    canvas.bar(x + 0.25 * part * length, y, 0.25 * length, 5.0 * unit,
               part % 2 ? kSoftInk : kDarkInk);
  }
  canvas.text(x, y - 6.0 * unit, 15.0 * unit, false, kDarkInk, formatted("%g m", metres));
}

/// Names of files may be anything; Cairo draws no text that is not UTF-8.
std::string asUtf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

void drawCaption(Canvas& canvas, const MapProducts& products, double unit) {
  double length = 0.0;
  for (const MapLine& line : products.lines) length += line.segment.length();
  const std::string numbers = formatted("%zu lines, %zu poly-lines, %.0f m of wall",
                                        products.lines.size(), products.poly_lines.size(), length);
  canvas.bar(0, 0, canvas.width(), kHeader * unit, kPaper);
  canvas.text(16.0 * unit, 28.0 * unit, 21.0 * unit, true, kDarkInk, asUtf8(products.title));
  canvas.text(16.0 * unit, 51.0 * unit, 15.0 * unit, false, kSoftInk, numbers);
}

/// Beside the numbers, where the sheet is wide enough.
void drawLegend(Canvas& canvas, double unit) {
  const std::array<std::pair<Colour, const char*>, 5> entries{{{kStart, "start"},
                                                               {kEnd, "end"},
                                                               {kTrajectory, "way"},
                                                               {kPalette.front(), "poly-line"},
                                                               {kDarkInk, "single line"}}};
  // Pixels of a sheet of 1600.
  constexpr double kBegin = 440.0, kWidthNeeded = 950.0, kLetter = 8.0;
  if (0.75 * canvas.width() < kWidthNeeded * unit) return;  // the scale bar has the last quarter
  double x = kBegin * unit;
  for (const auto& [colour, meaning] : entries) {
    canvas.bar(x, 43.0 * unit, 18.0 * unit, 6.0 * unit, colour);
    canvas.text(x + 24.0 * unit, 51.0 * unit, 15.0 * unit, false, kSoftInk, meaning);
    x += (48.0 + kLetter * static_cast<double>(std::strlen(meaning))) * unit;
  }
}

void extendByKnownCells(Box& box, const OccupancyRaster& grid) {
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    if (grid.values[k] != Occupancy::kUnknown) box.extend(grid.centreOf(grid.cell(k)));
  }
}

}  // namespace

Box wholeView(const MapProducts& products) {
  std::vector<WeightedPlace> pieces;
  const bool has_poses = !products.trajectory.empty();
  for (const MapLine& line : products.lines) {
    const Box box = Box(line.segment.start).extend(line.segment.end);
    pieces.push_back({box, has_poses ? 0.0 : line.segment.length()});
  }
  for (const Pose2& pose : products.trajectory) pieces.push_back({Box(pose.position()), 1.0});
  Box box;
  const std::vector<bool> stray = findStrays(pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!stray[k]) box.extend(pieces[k].box);
  }
  if (products.lines.empty() && products.grid) extendByKnownCells(box, *products.grid);
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
  const Eigen::Vector2d half =
      (0.5 * box.sizes().array() + kMarginOfPicture).max(0.5 * kSmallestView).matrix();
  return Box(box.center() - half, box.center() + half);
}

std::string picturePng(const MapProducts& products, const PictureOptions& options) {
  const Box view = options.view && !options.view->isEmpty() ? *options.view : wholeView(products);
  const int side = std::clamp(options.longest_side, kSmallestPicture, kLargestPicture);
  // Strokes and letters grow with the sheet, so that pictures look alike at any size.
  const double unit = std::max(kThinnest, side / 1600.0);
  Canvas canvas(view, side, options.caption ? static_cast<int>(kHeader * unit) : 0);
  canvas.fill(kUnknown);
  if (options.background && products.grid) drawBackground(canvas, *products.grid, view);
  drawRooms(canvas, options.rooms);
  if (options.trajectory) drawTrajectory(canvas, products.trajectory, unit);
  drawLines(canvas, products, unit);
  if (options.trajectory) drawEnds(canvas, products.trajectory, unit);
  if (options.caption) drawCaption(canvas, products, unit);
  if (options.caption) drawLegend(canvas, unit);
  drawScaleBar(canvas, options.caption, unit);
  return canvas.png();
}

void writePicture(const std::string& png_path, const MapProducts& products,
                  const PictureOptions& options) {
  writeFile(png_path, picturePng(products, options));
}

}  // namespace cca
