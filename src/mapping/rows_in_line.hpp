// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "mapping/map_noise.hpp"

namespace cca {

/// Clusters on one line, in order along it.
struct RowInLine {
  std::vector<std::size_t> members;  ///< indices of the clusters, from one end to the other
  LineSegment segment;               ///< through them, from the first to the last
};

/// Rows of clusters that stand in line by more than chance, the surest first, each cluster in one
/// of them at most. A seed is a pair of neighbours; its row is what lies on the line through both,
/// fitted anew with each that joins, with gaps of 2 m at most. A row is believed where as many
/// clusters on one line are expected by chance in less than one map of 10^4 [a contrario:
/// Desolneux, Moisan & Morel 2000].
///
/// @param clusters  m, their means, one frame for all.
/// @param noise     of the map that they are in.
/// Cost: O(n^2) of n clusters.
std::vector<RowInLine> rowsInLine(const std::vector<Eigen::Vector2d>& clusters,
                                  const MapNoise& noise);

}  // namespace cca
