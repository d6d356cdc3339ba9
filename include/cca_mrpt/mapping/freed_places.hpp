// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_set>

namespace cca {

/// The places of walls that rays have refuted. What comes to stand there again, a chair, a door, a
/// person, is believed only after more returns than elsewhere; without that, the map showed each
/// time what stood there last, though ten times as many rays had gone through.
///
/// Only places where a line once stood are kept, in cells of 30 cm: the memory is bounded by the
/// area, and no ray is traced for it. Deviation: the paper has no memory of what went.
class FreedPlaces {
 public:
  /// Notes a place, m, map frame. Cost: O(1).
  void add(const Eigen::Vector2d& p_map) { cells_.insert(cellOf(p_map)); }

  /// Whether something was refuted within the same cell. Cost: O(1).
  bool contains(const Eigen::Vector2d& p_map) const {
    return !cells_.empty() && cells_.count(cellOf(p_map)) > 0;
  }

 private:
  static std::int64_t cellOf(const Eigen::Vector2d& p_map);

  std::unordered_set<std::int64_t> cells_;
};

}  // namespace cca
