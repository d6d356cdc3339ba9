// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca {

/// A row of a CSV of numbers, with commas between its fields: where semicolons part them, as
/// spreadsheets write it, a comma is a decimal point.
inline std::string byCommas(std::string row) {
  if (row.find(';') == std::string::npos) return row;
  for (char& c : row) c = c == ',' ? '.' : c == ';' ? ',' : c;
  return row;
}

}  // namespace cca
