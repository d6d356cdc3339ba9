// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"
#include "line_log.hpp"

namespace cca {

/// A number that a row holds, or all rows share.
struct CsvQuantity {
  std::optional<std::size_t> column;
  double value = 0.0;  ///< where there is no column
  double unit = 1.0;   ///< what the column's numbers are to be multiplied by
};

/// Which columns of a CSV of ranges tell what, see csvOfRanges().
struct CsvHeader {
  char separator = ',';
  std::size_t columns = 0;
  std::vector<std::size_t> ranges;  ///< the column of each beam
  std::optional<CsvQuantity> angle_min, angle_max, angle_increment, range_min, range_max, time;
  std::optional<std::array<CsvQuantity, 3>> odometry, corrected;  ///< x, y, theta
  bool guesses_time_unit = false;
};

/// What lines above the header tell: `# angle_min=-1.57 angle_max: 1.57`.
using CsvPreamble = std::vector<std::pair<std::string, double>>;
void addToPreamble(std::string_view comment, CsvPreamble& preamble);

/// @throws MalformedLine naming what is missing or said twice.
CsvHeader readCsvHeader(std::string_view line, const CsvPreamble& preamble);

/// Whether a header names two ranges or more, complete or not.
bool namesRanges(std::string_view line);

/// The fields of a row, without blanks and quotes about them.
std::vector<std::string_view> rowFields(std::string_view line, char separator);

}  // namespace cca
