// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/beam.hpp"

#include <algorithm>
#include <cmath>

namespace cca {

bool looksTowards(const Scan& scan, const Eigen::Vector2d& p_map) {
  if (scan.size() == 0) return false;
  const Eigen::Vector2d to = p_map - scan.T_map_sensor.position();
  const double last = scan.bearing(scan.size() - 1);
  const double middle = 0.5 * (scan.angle_min + last), half = 0.5 * std::abs(last - scan.angle_min);
  const double off = wrapAngle(std::atan2(to.y(), to.x()) - scan.T_map_sensor.theta - middle);
  return std::abs(off) <= half + std::abs(scan.angle_increment);
}

std::uint32_t sectorsInView(const Scan& scan) {
  constexpr int kSectors = 32;  // bits of the word that they are kept in
  constexpr double kSector = 2.0 * M_PI / kSectors;
  const double span = static_cast<double>(scan.size()) * std::abs(scan.angle_increment);
  if (scan.size() == 0 || !std::isfinite(span)) return 0;
  if (span >= 2.0 * M_PI - 0.5 * std::abs(scan.angle_increment)) return ~std::uint32_t{0};
  const double last = scan.bearing(scan.size() - 1);
  const double from = scan.T_map_sensor.theta + std::min(scan.angle_min, last);
  if (!std::isfinite(from)) return 0;
  std::uint32_t directions = 0;
  const double lowest = std::floor(from / kSector);
  const int count = static_cast<int>(std::floor((from + span) / kSector) - lowest);
  for (int k = 0; k <= count; ++k) {
    const double sector = std::fmod(lowest + k, kSectors);
    directions |= 1u << static_cast<int>(sector < 0.0 ? sector + kSectors : sector);
  }
  return directions;
}

}  // namespace cca
