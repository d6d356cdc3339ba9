// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// K-means [Lloyd 1982] of points that are seen in order of bearing.
///
/// Seeds are the middle points of K equal shares of the sequence. The distance between a point and
/// a centroid is at least r sin(difference of bearing): the search for the nearest centroid walks
/// from the point's own bearing both ways and stops where this bound passes the best distance, so
/// the assignment is that of the full Lloyd sweep over all K, at a cost that does not grow with K.
///
/// @param clusters  K, > 0.
/// @param sweeps    largest number of assignments; fewer where nothing moves any more; with 0 the
///                  shares stay as they are.
/// @return          the cluster of each point, in 0..K-1; clusters may run empty.
/// Cost: O(N + K log K) a sweep, for scenes whose depth does not alternate from beam to beam.
std::vector<int> kMeansInOrder(const ScanPoints& points, int clusters, int sweeps);

}  // namespace cca
