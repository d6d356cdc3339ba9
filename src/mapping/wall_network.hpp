// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"
#include "mapping/map_similarity.hpp"
#include "mapping/walls.hpp"

namespace cca {

/// The walls as a geodetic network: each scan is a station of unknown pose that sights walls, the
/// first one is held [Wolf & Ghilani 1997, ch. 15-17].
///
/// Where the poses come from the scans themselves, scans err together: what one wall is off, all
/// that were seen with it are, and more so with each station between them and the first one. No
/// residual shows that. The covariance of the adjustment of all poses and walls does. The map is
/// not that adjustment: scan matching weighs returns as it must to hold in clutter. What a wall
/// lies off it adds to its error, by three deviations at most: beyond, the adjustment has gone
/// astray. Scans are matched surface by surface, and none knows that a long wall is straight: each
/// patch of 2 m has an offset and a direction of its own.
class WallNetwork {
 public:
  void add(const Pose2& T_map_sensor, const std::vector<NewLine>& lines);

  /// Gives each wall its `pose_covariance`; of what no station sights, the largest.
  /// Cost: O(stations x sightings^2), a sparse Cholesky factorisation over the patches, and its
  /// inverse where the factor is not zero.
  void settle(const MapNoise& noise, Walls& walls) const;

 private:
  struct Sighting {
    Eigen::Vector2d start, end;  ///< m, map frame
    double returns;
  };
  struct Station {
    Eigen::Vector2d position;
    std::vector<Sighting> sightings;
  };
  class Adjustment;
  std::vector<Station> stations_;
};

}  // namespace cca
