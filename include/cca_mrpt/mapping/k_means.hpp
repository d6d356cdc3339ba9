// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cca {

/// K-means [Lloyd 1982] in the plane, exact: the nearest of all centroids wins, the lowest index
/// where several are equally near.
///
/// @param seeds   K of them, at least one where there are points.
/// @param sweeps  largest number of assignments; fewer where nothing moves any more.
/// @return        the cluster of each point, in 0..K-1; clusters may run empty.
/// Cost: O(N sqrt K) a sweep for spread-out points: centroids are searched outwards from the point
/// in x, until x alone is farther than the best.
std::vector<int> kMeans(const std::vector<Eigen::Vector2d>& points,
                        std::vector<Eigen::Vector2d> seeds, int sweeps);

/// Lloyd's other half: moves each centroid to the mean of its points; one without points stays.
/// @param cluster  of each point, an index of *centroids.
void moveToMeans(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& cluster,
                 std::vector<Eigen::Vector2d>* centroids);

}  // namespace cca
