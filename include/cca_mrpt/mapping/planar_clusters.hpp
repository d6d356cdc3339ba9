// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/description_length.hpp"
#include "cca_mrpt/mapping/point_set.hpp"

namespace cca {

/// Points of one line, by index.
struct PlanarCluster {
  std::vector<int> members;
  FittedSegment fit;
  double low = 0.0, high = 0.0;  ///< m, extent along the line, from its centroid
  double reach = 0.0;            ///< m, longest step between neighbours on one wall

  Eigen::Vector2d at(double along) const { return fit.line.centroid + along * fit.line.direction; }
};

/// @param variance  m^2, of each point's distance from its wall.
FittedSegment fitTo(const PointMoments& moments, double variance);

/// @param members  indices of the points; one at least.
PlanarCluster planarCluster(const std::vector<SpatialPoint>& points, std::vector<int> members);

/// Step 2 for points in no order: K-means in the plane, then each cluster split by 2-means until it
/// is straight within the noise and without a gap. Together they hold every point once.
/// Cost: O(N sqrt(K)) for K clusters of N points.
std::vector<PlanarCluster> planarClusters(const std::vector<SpatialPoint>& points,
                                          int points_per_cluster);

}  // namespace cca
