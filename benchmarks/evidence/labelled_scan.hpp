// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "evaluation/spatial_index.hpp"
#include "simulation/laser.hpp"
#include "simulation/random.hpp"

/// What the claims rest on: scans with known truth, scores, statistics.
namespace cca::evidence {

/// What of a wall that something partly hides an ideal extractor would find.
enum class HiddenWalls {
  kWhole,   ///< one edge, from the first to the last of its rays
  kPieces,  ///< an edge for each stretch of neighbouring rays
};

/// A scan, and what an ideal extractor would find in it.
struct LabelledScan {
  std::string source;
  Scan scan;
  bool has_truth = false;
  std::vector<Segment2> edges;  ///< sensor frame
  std::vector<int> rays;        ///< for each edge: the rays that it receives
};

/// How scans are drawn. The places depend on the seed alone, the noise on seed and amount: the same
/// seed gives the same places at every noise level.
struct Sampling {
  int scans = 100;
  LaserParameters laser;
  double clearance = 0.3;  ///< m, of the sensor from obstacles
  HiddenWalls hidden_walls = HiddenWalls::kWhole;
  std::uint64_t seed = 1;
};

/// One sweep over exact segments (no grid: a wall has no stair-case of cells), with its labels.
/// @param edges_map  true walls, map frame.
LabelledScan sweepOverEdges(const std::vector<Segment2>& edges_map, const Pose2& T_map_sensor,
                            const LaserParameters& laser, Random& random,
                            HiddenWalls hidden_walls = HiddenWalls::kWhole);

/// Scans at random free places of a world, facing at random.
/// @throws std::runtime_error for files that cannot be read, or where no place is free enough.
std::vector<LabelledScan> sampleWorld(const std::string& yaml_path, const Sampling& sampling);

/// Scans from inside random star-shaped polygons of 3 to 36 edges, 2 to 10 m around the sensor.
std::vector<LabelledScan> samplePolygons(const Sampling& sampling);

/// Evenly spaced scans of a log; they have no truth.
/// @throws std::runtime_error as openLog() does.
std::vector<LabelledScan> sampleLog(const std::string& path, int scans);

}  // namespace cca::evidence
