// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/scanned_places.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/navigation/place/free_space.hpp"

namespace cca {
namespace {

constexpr int kSectors = 32;
constexpr std::uint32_t kAll = 0xFFFFFFFF;

std::uint32_t directionsOf(const Scan& scan) {
  constexpr double kSector = 2.0 * M_PI / kSectors;
  const double span = static_cast<double>(scan.size()) * std::abs(scan.angle_increment);
  if (scan.size() == 0 || !std::isfinite(span)) return 0;
  if (span >= 2.0 * M_PI - 0.5 * std::abs(scan.angle_increment)) return kAll;
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

}  // namespace

void ScannedPlaces::add(Cell robot, const Scan& scan) {
  const Cell block = FreeSpace::blockOf(robot);
  if (containsBlock(block)) return;
  std::uint32_t& looked = looked_[block];
  looked |= directionsOf(scan);
  if (looked == kAll) done_[block] = 1;
}

void ScannedPlaces::addAll(Cell robot) { done_[FreeSpace::blockOf(robot)] = 1; }

bool ScannedPlaces::contains(Cell c) const { return containsBlock(FreeSpace::blockOf(c)); }

}  // namespace cca
