// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "mapping/map_noise.hpp"
#include "mapping/wall.hpp"

namespace cca {

/// What is left over: returns on no wall of the map, place by place, with a few of the scans that
/// looked there. No single scan shows a row of posts, or a pane that returns one beam in five, as a
/// line; all of them together do.
///
/// Memory is bounded by the area: a place of 10 cm has its sums, a square metre of the floor the
/// last four scans that were taken half a metre apart.
class LooseReturns {
 public:
  /// Whether the scan adds to what is known: the last one kept was taken elsewhere.
  bool wants(const Scan& scan) const;
  /// @param loose  returns on no wall, m, map frame.
  void add(const Scan& scan, const std::vector<Eigen::Vector2d>& loose);

  /// Dotted walls, the surest first, without ids: rows of places that stand in line by more than
  /// chance, see rowsInLine(). Clusters of the places are by K-means. Rays speak for each cluster
  /// alone: what most of them passed went away.
  /// @param walls  lines of the map; what lies beside one is that wall's.
  /// Cost: O(clusters x (scans kept + lines)).
  std::vector<MapLine> dottedWalls(const std::vector<MapLine>& walls, const MapNoise& noise) const;

 private:
  struct Place {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double returns = 0.0;
    double ranges = 0.0;   ///< m, their sum
    int looks = 0;         ///< scans that saw something there
    std::size_t last = 0;  ///< the last of them
  };
  struct Look {
    std::size_t number;
    Pose2 T_map_sensor;
    double angle_min, angle_increment;
    std::vector<float> ranges;  ///< m, of the returns
    std::vector<float> free;    ///< m, up to which the beam saw free space
  };
  struct Cluster {
    Eigen::Vector2d mean;
    int looks;
  };
  struct Verdict {
    int returned = 0, passed = 0;
    int passed_since = 0;  ///< the last that returned
  };
  std::vector<Cluster> clusters(const std::vector<MapLine>& walls, const MapNoise& noise) const;
  Verdict ask(const Eigen::Vector2d& p) const;
  double shareOf(const LineSegment& row) const;

  std::unordered_map<std::int64_t, Place> places_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> looks_at_;  ///< by where they stood
  std::vector<Look> looks_;
  std::size_t number_ = 0;  ///< of looks so far
  Pose2 last_;
};

}  // namespace cca
