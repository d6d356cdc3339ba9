// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "known_map/plan_sight.hpp"

namespace cca {

/// Pieces of a plan that beams go through: doors that stand open, walls that are gone.
class OpenDoors {
 public:
  explicit OpenDoors(std::size_t pieces) : records_(pieces), is_open_(pieces, false) {}

  /// What the beams of a scan that is localised say.
  /// @param share  in [0, 1], of the scan that is news. Cost: O(said).
  void learn(const std::vector<PieceSight>& said, double share);
  /// By PlanLines::Slot.
  const std::vector<bool>& isOpen() const { return is_open_; }

 private:
  struct Record {
    double explained = 0.0, through = 0.0;  ///< beams
  };
  std::vector<Record> records_;
  std::vector<bool> is_open_;
};

}  // namespace cca
