// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "io/lines/line_formats.hpp"
#include "io/plans/plan_formats.hpp"

namespace cca {

std::vector<MapLine> wallsOfCsv(const std::string& text, const std::string& name) {
  std::vector<MapLine> walls = readLinesCsv(text, name);
  walls.erase(std::remove_if(walls.begin(), walls.end(),
                             [](const MapLine& line) { return line.kind != LineKind::kWall; }),
              walls.end());
  return walls;
}

}  // namespace cca
