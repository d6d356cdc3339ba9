// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/line_texts.hpp"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace cca {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;

}  // namespace

std::string linesCsv(const std::vector<MapLine>& lines) {
  std::string text = "x1,y1,x2,y2,id,support,length,sigma_offset,sigma_angle_deg\n";
  char row[256];
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    std::snprintf(row, sizeof row, "%.4f,%.4f,%.4f,%.4f,%" PRIu64 ",%.1f,%.4f,%.6f,%.6f\n",
                  s.start.x(), s.start.y(), s.end.x(), s.end.y(), line.id, line.support, s.length(),
                  std::sqrt(std::max(0.0, s.covariance(0, 0))),
                  kDegreesPerRadian * std::sqrt(std::max(0.0, s.covariance(1, 1))));
    text += row;
  }
  return text;
}

}  // namespace cca
