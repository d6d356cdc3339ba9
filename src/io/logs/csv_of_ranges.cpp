// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "csv_header.hpp"
#include "io/files/text.hpp"
#include "text_formats.hpp"

namespace cca {
namespace {

constexpr std::size_t kLongestQuote = 40;  // bytes of a field: more would hide the rule

/// Times without a unit: seconds up to the year 5138, then milliseconds, microseconds, nanoseconds
/// of times since 1970.
double secondsOf(double stamp) {
  const double size = std::abs(stamp);
  if (size < 1e11) return stamp;
  return stamp * (size < 1e14 ? 1e-3 : size < 1e17 ? 1e-6 : 1e-9);
}

/// The beginning of a field, for messages: a file may hold any bytes.
std::string quoted(std::string_view field) {
  std::string text = "'";
  for (const char c : field.substr(0, kLongestQuote)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + "'";
}

/// A row of a CSV of ranges.
class CsvRow {
 public:
  CsvRow(const CsvHeader& header, std::string_view line)
      : header_(header), fields_(rowFields(line, header.separator)) {
    // Some programs write a separator behind the last field, too.
    if (fields_.size() == header.columns + 1 && fields_.back().empty()) fields_.pop_back();
    if (fields_.size() != header.columns) {
      throw MalformedLine("a row of " + std::to_string(header.columns) +
                          " fields is needed, as the header has; there are " +
                          std::to_string(fields_.size()));
    }
  }

  /// @throws MalformedLine naming the column.
  double number(const CsvQuantity& quantity) const {
    if (!quantity.column) return quantity.value;
    const std::string_view field = fields_[*quantity.column];
    const auto value = numberOf(field);
    if (value && std::isfinite(*value)) return *value * quantity.unit;
    throw MalformedLine("column " + std::to_string(*quantity.column + 1) +
                        ": a finite number is needed, not " + quoted(field));
  }

  Pose2 pose(const std::array<CsvQuantity, 3>& quantities) const {
    return {number(quantities[0]), number(quantities[1]), wrapAngle(number(quantities[2]))};
  }

  Scan scan() const {
    Scan scan;
    scan.angle_min = number(*header_.angle_min);
    scan.angle_increment = header_.angle_increment
                               ? number(*header_.angle_increment)
                               : (number(*header_.angle_max) - scan.angle_min) /
                                     static_cast<double>(header_.ranges.size() - 1);
    const double lowest = header_.range_min ? number(*header_.range_min) : 0.0;
    const double highest =
        header_.range_max ? number(*header_.range_max) : std::numeric_limits<double>::infinity();
    if (std::isfinite(highest) && highest > 0.0) scan.free_range_without_return = highest;
    for (const std::size_t column : header_.ranges) {
      const double range = rangeIn(column);
      const bool is_meant = range > 0.0 && range >= lowest;
      scan.ranges.push_back(!is_meant         ? std::numeric_limits<double>::quiet_NaN()
                            : range > highest ? std::numeric_limits<double>::infinity()
                                              : range);
    }
    return scan;
  }

 private:
  double rangeIn(std::size_t column) const {
    if (fields_[column].empty()) return std::numeric_limits<double>::quiet_NaN();
    if (const auto value = numberOf(fields_[column])) return *value;
    throw MalformedLine("column " + std::to_string(column + 1) + ": a range is needed, not " +
                        quoted(fields_[column]));
  }

  const CsvHeader& header_;
  std::vector<std::string_view> fields_;
};

class CsvOfRanges : public LineFormat {
 public:
  std::optional<LogRecord> parse(std::string_view line) override {
    if (withoutBlanks(line).empty()) return std::nullopt;
    if (line.front() == '#' && (header_ || !namesRanges(line))) {
      if (!header_) addToPreamble(line, preamble_);
      return std::nullopt;
    }
    if (!header_) {
      header_ = readCsvHeader(line, preamble_);
      return std::nullopt;
    }
    const CsvRow row(*header_, line);
    LogRecord record;
    record.scan = row.scan();
    requireOneTurn(record.scan);
    record.has_time = header_->time.has_value();
    if (header_->time) {
      const double stamp = row.number(*header_->time);
      record.time = header_->guesses_time_unit ? secondsOf(stamp) : stamp;
    }
    if (header_->odometry) record.odometry = row.pose(*header_->odometry);
    if (header_->corrected) record.corrected = row.pose(*header_->corrected);
    record.scan.T_map_sensor =
        record.corrected ? *record.corrected : record.odometry.value_or(Pose2());
    return record;
  }

 private:
  CsvPreamble preamble_;
  std::optional<CsvHeader> header_;
};

/// The first lines of a file, until one is no comment. @return  that one; empty where all are.
std::string_view firstLine(std::string_view head) {
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    const std::string_view line = withoutBlanks(head.substr(0, end));
    if (!line.empty() && (line.front() != '#' || namesRanges(line))) return line;
    head.remove_prefix(std::min(end + 1, head.size()));
  }
  return {};
}

}  // namespace

std::unique_ptr<LineFormat> csvOfRanges() { return std::make_unique<CsvOfRanges>(); }

bool looksLikeCsvOfRanges(const std::string& head) { return namesRanges(firstLine(head)); }

}  // namespace cca
