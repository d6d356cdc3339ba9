// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/open_doors.hpp"

namespace cca {
namespace {

/// Rays through a piece, for it to be a door that stands open, and over those that it explains.
constexpr double kRaysThroughDoor = 6.0, kThroughOverExplained = 3.0;
constexpr double kRecordLimit = 50.0;  // rays, of which half are forgotten: doors open and shut

}  // namespace

void OpenDoors::learn(const std::vector<PieceSight>& said, double share) {
  for (const PieceSight& sight : said) {
    const auto slot = static_cast<std::size_t>(sight.slot);
    Record& record = records_[slot];
    double& count = sight.is_through ? record.through : record.explained;
    count += share;
    if (count > kRecordLimit) {
      record.through *= 0.5;
      record.explained *= 0.5;
    }
    is_open_[slot] = record.through > kRaysThroughDoor &&
                     record.through > kThroughOverExplained * record.explained;
  }
}

}  // namespace cca
