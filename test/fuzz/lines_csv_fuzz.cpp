// SPDX-License-Identifier: BSD-3-Clause
// Any text through readLinesCsv(): refused, or lines of finite numbers that are written and read
// back the same.
#include <cstdlib>
#include <stdexcept>

#include "io/lines/line_formats.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::vector<cca::MapLine> lines;
  try {
    lines = cca::readLinesCsv(std::string(reinterpret_cast<const char*>(bytes), size), "fuzz");
  } catch (const std::runtime_error&) {
    return 0;
  }
  for (const auto& line : lines) {
    if (!line.segment.start.allFinite() || !line.segment.end.allFinite()) std::abort();
  }
  if (cca::readLinesCsv(cca::linesCsv(lines), "again").size() != lines.size()) std::abort();
  return 0;
}
