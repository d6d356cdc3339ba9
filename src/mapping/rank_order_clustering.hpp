// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/similarity.hpp"

namespace cca {

/// Sorts of rows and columns before the order is taken as it is.
inline constexpr int kMostRankOrderSweeps = 10;

/// Groups the segments that describe one wall: Rank Order Clustering [King 1980].
///
/// B_ij = [S_ij >= cut]; rows and columns are sorted as binary words until nothing moves; a group
/// is a diagonal block whose members are all alike. Deviation: words are compared bit by bit
/// (King's weights 2^(n-j) overflow for n > 63). S being symmetric, rows and columns move together.
/// King stops at the reordered matrix and leaves the blocks to the eye; here a block grows while
/// its next row is similar to every member (complete linkage), for a curved wall is one long chain
/// in which only neighbours are alike.
///
/// Deviation: King sorts until nothing moves. Along a chain of likenesses the order creeps by one
/// neighbourhood a sweep, up to n sweeps, long after the groups stand: it stops at
/// kMostRankOrderSweeps. Groups keep complete linkage in any order, and merging is repeated.
///
/// @return     the group of each segment; groups are numbered from 0 on, in ROC order.
/// Cost: O(m log n) a sweep for m likenesses.
std::vector<int> rankOrderGroups(const SimilarityMatrix& similarity, const AlphaCut& cut);

}  // namespace cca
