// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// What is known of each place: unknown, free or occupied. Grows as the robot moves.
class ExplorationGrid {
 public:
  /// Traces the scan's beams from T_map_sensor. Cost: cells crossed, whatever the grid's size.
  void insert(const Scan& scan);
};

}  // namespace cca
