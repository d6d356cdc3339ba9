// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "cca_mrpt/mapping/scan.hpp"
#include "cca_mrpt/navigation/place/cell.hpp"

namespace cca {

/// The places from which all directions have been looked into, by blocks of the free space (0.2 m):
/// nothing more is to be seen from there, so they are no goals.
class ScannedPlaces {
 public:
  /// Takes the directions (map frame) that a scan looks into, in 32 sectors. Scans of a narrow
  /// field of view add up.
  void add(Cell robot, const Scan& scan);

  /// All directions, wherever the laser has looked.
  void addAll(Cell robot);

  bool contains(Cell c) const;
  bool containsBlock(Cell block) const { return done_.at(block) != 0; }

 private:
  TiledGrid<char> done_{0};
  TiledGrid<std::uint32_t> looked_{0};  ///< the directions, a bit each, while some are missing
};

}  // namespace cca
