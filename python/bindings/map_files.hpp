// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/slam/pose_graph.hpp"
#include "io/files/memory_file.hpp"

namespace cca::python {

struct LinesAndChains {
  std::vector<MapLine> lines;
  std::vector<PolyLine> poly_lines;
  std::vector<MapArc> arcs;
};

/// What a session has made of its scans, in the session's frame.
struct MappedScans {
  LinesAndChains map;
  std::vector<Pose2> trajectory;
  std::vector<double> times;
  std::vector<bool> is_placed;
  double distance = 0.0;  ///< m
  PoseGraph graph;        ///< of SLAM; empty: there was none
  StoredMemory memory;
  OccupancyRaster grid;  ///< of the scans, in the same frame
  std::size_t loops = 0, beams = 0;
  std::string pose;
  double agreement = 0.0;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: where that frame lies
  bool finished = false;
  std::string resumed;                  ///< folder of the map that this one goes on with
  std::optional<bool> found_in_memory;  ///< whether its place was found there
  std::string warnings, shortcoming;
  std::string replay;  ///< Replay::packed(), of the same frame; empty: there is none
};

/// (dict of arrays and numbers, dict of files by name), in the map frame.
nanobind::object filesAndArrays(MappedScans result);

}  // namespace cca::python
