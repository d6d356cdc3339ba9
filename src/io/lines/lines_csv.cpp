// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"

namespace cca {
namespace {

constexpr std::array<const char*, 11> kColumns = {
    "x1",    "y1",          "x2",       "y2", "id", "support", "sigma_offset", "sigma_angle_deg",
    "share", "sigma_start", "sigma_end"};
constexpr std::size_t kNeeded = 4;
constexpr double kLargestValue =
    1e16;  // in whatever column: what is read must fit a row when written
constexpr double kLargestSigma = 1e8;  // m or deg; its square keeps its digits

double sigma(double variance) { return std::sqrt(std::max(0.0, variance)); }

/// m, lateral, of a line at a place that lies so far, m, beyond its middle.
double sigmaAt(double beyond, const Eigen::Matrix2d& c) {
  return sigma(c(0, 0) + 2.0 * beyond * c(0, 1) + beyond * beyond * c(1, 1));
}

/// Of a line's offset and angle, from their deviations and those of its ends, which are equal where
/// nobody has told them.
Eigen::Matrix2d covarianceOf(double offset, double angle, double start, double end, double length) {
  const double most = offset * angle;
  const double both = length > 0.0 ? 0.5 * (end * end - start * start) / length : 0.0;
  Eigen::Matrix2d c;
  c << offset * offset, std::clamp(both, -most, most), 0.0, angle * angle;
  c(1, 0) = c(0, 1);
  return c;
}

std::vector<std::string> cells(std::string row) {
  if (!row.empty() && row.back() == '\r') row.pop_back();
  std::vector<std::string> cells;
  std::istringstream stream(byCommas(std::move(row)));
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// Which cell of a row holds each of kColumns; the row's size where none does.
std::array<std::size_t, kColumns.size()> findColumns(const std::vector<std::string>& header,
                                                     const std::string& name) {
  std::array<std::size_t, kColumns.size()> at{};
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    const auto found = std::find(header.begin(), header.end(), kColumns[k]);
    if (found == header.end() && k < kNeeded) {
      throw std::runtime_error(name + ": not a line map: no column " + kColumns[k] +
                               " in the header (needed: x1,y1,x2,y2)");
    }
    at[k] = static_cast<std::size_t>(found - header.begin());
  }
  return at;
}

double number(const std::string& cell, double largest, const std::string& where) {
  double value = 0.0;
  const char* const end = cell.data() + cell.size();
  const auto result = std::from_chars(cell.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || !(std::abs(value) <= largest)) {
    throw std::runtime_error(where + ": '" + cell + "' must be a number in " +
                             (largest < kLargestValue ? "[-1e8, 1e8] m" : "[-1e16, 1e16]"));
  }
  return value;
}

}  // namespace

std::string linesCsv(const std::vector<MapLine>& lines) {
  std::string text =
      "x1,y1,x2,y2,id,support,length,sigma_offset,sigma_angle_deg,kind,share,"
      "sigma_start,sigma_end\n";
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const double half = 0.5 * s.length();
    text += formatted("%.4f,%.4f,%.4f,%.4f,%" PRIu64 ",%.1f,%.4f,%.6f,%.6f,%s,%.4f,%.6f,%.6f\n",
                      s.start.x(), s.start.y(), s.end.x(), s.end.y(), line.id, line.support,
                      s.length(), sigma(s.covariance(0, 0)),
                      kDegreesPerRadian * sigma(s.covariance(1, 1)), nameOf(line.kind), line.share,
                      sigmaAt(-half, s.covariance), sigmaAt(half, s.covariance));
  }
  return text;
}

std::string arcsCsv(const std::vector<MapArc>& arcs) {
  std::string text = "x,y,radius,start_deg,sweep_deg,sigma_x,sigma_y,sigma_radius,line_ids\n";
  for (const MapArc& found : arcs) {
    const Arc& arc = found.arc;
    text += formatted("%.4f,%.4f,%.4f,%.3f,%.3f,%.6f,%.6f,%.6f,", arc.centre.x(), arc.centre.y(),
                      arc.radius, kDegreesPerRadian * arc.start_angle,
                      kDegreesPerRadian * arc.sweep, sigma(arc.covariance(0, 0)),
                      sigma(arc.covariance(1, 1)), sigma(arc.covariance(2, 2)));
    const char* separator = "";
    for (const std::uint64_t id : found.line_ids) {
      text += separator + std::to_string(id);
      separator = " ";
    }
    text += "\n";
  }
  return text;
}

std::vector<MapLine> readLinesCsv(const std::string& text, const std::string& name) {
  std::istringstream rows(text);
  std::string row;
  std::getline(rows, row);
  const std::vector<std::string> header = cells(std::string(withoutMark(row)));
  const auto at = findColumns(header, name);
  const auto kind_at =
      static_cast<std::size_t>(std::find(header.begin(), header.end(), "kind") - header.begin());
  std::vector<MapLine> lines;
  for (std::size_t number_of_row = 2; std::getline(rows, row); ++number_of_row) {
    const std::vector<std::string> values = cells(row);
    if (values.empty()) continue;
    std::array<double, kColumns.size()> value{};
    value[4] = static_cast<double>(lines.size());
    value[8] = 1.0;
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
      if (at[k] == header.size()) continue;
      const std::string where =
          name + ", row " + std::to_string(number_of_row) + ", column " + kColumns[k];
      if (at[k] >= values.size()) throw std::runtime_error(where + ": missing");
      value[k] = number(values[at[k]], k < kNeeded ? kFarthestPlan : kLargestValue, where);
    }
    MapLine line;
    line.segment.start = {value[0], value[1]};
    line.segment.end = {value[2], value[3]};
    line.id = static_cast<std::uint64_t>(std::clamp(value[4], 0.0, 9e15));
    line.support = value[5];
    const double offset = std::min(std::abs(value[6]), kLargestSigma);
    const double angle = std::min(std::abs(value[7]), kLargestSigma) / kDegreesPerRadian;
    const double start = std::min(std::abs(value[9]), kLargestSigma);
    const double end = std::min(std::abs(value[10]), kLargestSigma);
    line.segment.covariance = covarianceOf(offset, angle, start, end, line.segment.length());
    const bool is_dotted = kind_at < values.size() && values[kind_at] == nameOf(LineKind::kDotted);
    line.kind = is_dotted ? LineKind::kDotted : LineKind::kWall;
    line.share = value[8];
    lines.push_back(line);
  }
  return lines;
}

std::vector<MapLine> loneLines(const std::vector<MapLine>& lines,
                               const std::vector<PolyLine>& poly_lines) {
  std::unordered_set<std::uint64_t> chained;
  for (const PolyLine& chain : poly_lines) {
    chained.insert(chain.line_ids.begin(), chain.line_ids.end());
  }
  std::vector<MapLine> lone;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(lone),
               [&](const MapLine& line) { return chained.count(line.id) == 0; });
  return lone;
}

}  // namespace cca
