// SPDX-License-Identifier: BSD-3-Clause
#include "io/lines/segments_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "io/files/text.hpp"

namespace cca {
namespace {

constexpr double kFarthestEnd = 1e7;     // m; as in a line map
constexpr double kLongestSegment = 1e5;  // m; what is scored is sampled every few centimetres

using Row = std::vector<std::string>;

/// The cells of a row, by comma, semicolon or blank; none of a comment.
Row cellsOf(std::string line) {
  if (line[0] == '#') return {};
  line = byCommas(std::move(line));
  for (char& c : line) c = c == ',' || c == '\r' ? ' ' : c;
  std::istringstream text(line);
  return {std::istream_iterator<std::string>(text), {}};
}

/// Which cell of a row holds x1, y1, x2, y2, by the names of a header.
using Columns = std::array<std::size_t, 4>;
std::optional<Columns> columnsOf(const Row& header) {
  Columns columns{};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const char* const names[] = {"x1", "y1", "x2", "y2"};
    const auto found = std::find(header.begin(), header.end(), names[k]);
    if (found == header.end()) return std::nullopt;
    columns[k] = static_cast<std::size_t>(found - header.begin());
  }
  return columns;
}

/// Nothing where a cell is missing, no number, or where no building reaches.
std::optional<Segment2> segmentOf(const Row& row, const Columns& columns) {
  double value[4] = {};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] >= row.size()) return std::nullopt;
    char* end = nullptr;
    value[k] = std::strtod(row[columns[k]].c_str(), &end);
    if (*end != '\0' || !(std::abs(value[k]) <= kFarthestEnd)) return std::nullopt;
  }
  const Segment2 segment{{value[0], value[1]}, {value[2], value[3]}};
  if (segment.length() > kLongestSegment) return std::nullopt;
  return segment;
}

}  // namespace

std::vector<Segment2> loadSegments(const std::string& csv_path) {
  return readSegments(contentOf(csv_path), csv_path);
}

std::vector<Segment2> readSegments(const std::string& text, const std::string& name) {
  std::istringstream file(text);
  std::vector<Segment2> segments;
  Columns columns{0, 1, 2, 3};
  bool is_first = true;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const Row row = cellsOf(std::string(number == 1 ? withoutMark(line) : line));
    if (row.empty()) continue;
    const bool may_be_header = std::exchange(is_first, false);
    if (const auto segment = segmentOf(row, columns)) {
      segments.push_back(*segment);
    } else if (const auto named = columnsOf(row); may_be_header && named) {
      columns = *named;
    } else {
      throw std::runtime_error(name + ":" + std::to_string(number) +
                               ": needs four numbers x1,y1,x2,y2 in [-1e7, 1e7] m, a segment of "
                               "1e5 m at most, or a header with these names before all");
    }
  }
  if (is_first) throw std::runtime_error(name + ": is empty");
  return segments;
}

std::string truthPath(const std::string& yaml_path) {
  return std::filesystem::path(yaml_path).replace_extension(".truth.csv").string();
}

}  // namespace cca
