// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cca {

/// A part of the algorithm that can be left out, one at a time, to see what it is worth: by nobody
/// else than benchmarks (docs/ablation.md).
enum class Part : std::uint8_t {
  kOrientation,      ///< mu_1; it counts as 1, as the other four do
  kOffset,           ///< mu_2
  kGap,              ///< mu_3
  kFit,              ///< mu_4
  kOverlap,          ///< mu_5
  kRankOrder,        ///< King's sorts: groups are grown in the order that the lines came in
  kCompleteLinkage,  ///< one member alike is enough: chains of likenesses
  kKMeans,        ///< boundaries of clusters stay where they are, at first and among merged lines
  kPruning,       ///< K-means begins with equal shares as they are
  kRounds,        ///< one round of clustering in a scan, not until nothing is alike
  kCorners,       ///< K-means once, before lines are merged, and with that K
  kInterrupted,   ///< pieces of a wall that something hides stay apart
  kScanNoise,     ///< a range noise of 3 cm instead of the scan's own
  kPoseNoise,     ///< a pose error of 3 cm and 0.01 rad instead of what the map has learned
  kWallsToWalls,  ///< walls are not clustered again
  kYielding,      ///< stretches side by side stay with both walls
  kBends,         ///< walls are not cut
  kRays,          ///< rays that went through say nothing
  kHindsight,     ///< the evidence of all scans is not assigned anew at the end
};

/// The parts that are left out: none.
class Ablation {
 public:
  constexpr Ablation() = default;
  constexpr explicit Ablation(Part part) : left_out_(bit(part)) {}
  constexpr bool operator()(Part part) const { return (left_out_ & bit(part)) != 0; }

 private:
  static constexpr std::uint32_t bit(Part part) {
    return std::uint32_t{1} << static_cast<unsigned>(part);
  }
  std::uint32_t left_out_ = 0;
};

}  // namespace cca
