// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/description_length.hpp"
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
/// @param sweeps    largest number of assignments; fewer where nothing moves any more.
/// @return          the cluster of each point, in 0..K-1; clusters may run empty.
/// Cost: O(N + K log K) a sweep, for scenes whose depth does not alternate from beam to beam.
std::vector<int> kMeansInOrder(const ScanPoints& points, int clusters, int sweeps);

/// Point clusters of a scan: K-means with K = round(N / points_per_cluster), then pruning.
///
/// Pruning: a cluster falls into runs of neighbouring points without an inner gap; a run whose
/// points do not lie on one line within the noise is split by 2-means until all do.
/// An inner gap is a beam without return or a step in depth (ScanPoints::breaks): without that test
/// three points across a step always make a line.
/// @return  runs in scan order that cover all points, each with the line that pruning fitted to it.
/// Cost: O(N) for K-means; O(k^2) to prune a cluster of k points, k being bounded by the parameter.
std::vector<FittedRun> pointClusters(const ScanPoints& points, const RunFitter& fitter,
                                     int points_per_cluster);

}  // namespace cca
