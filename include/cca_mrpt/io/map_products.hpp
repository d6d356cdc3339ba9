// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/geometry/pose2.hpp"
#include "cca_mrpt/io/geo_reference.hpp"
#include "cca_mrpt/mapping/map_line.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/pose_graph.hpp"

namespace cca {

/// What a run brings home: all that the files of a map's folder are made from. It stands in a frame
/// of its own, for MRPT's grid could not be far from (0, 0); the files are written in the map
/// frame.
struct MapProducts {
  std::string title;  ///< for people: the log's or the world's name
  std::vector<MapLine> lines;
  std::vector<PolyLine> poly_lines;
  std::vector<MapArc> arcs;
  std::vector<Pose2> trajectory;  ///< T_map_robot, in order of time; may be empty
  /// Occupancy of the same place (see ScanRaster); nothing: no map.pgm, no background in the
  /// picture.
  std::optional<OccupancyRaster> grid;
  /// m, map frame: where the frame of all this lies, see localOrigin().
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  /// Where the map frame lies on the Earth, for lines.geojson and lines.svg; nothing: in metres.
  std::optional<GeoReference> place;
  /// s, of each pose of the trajectory, for poses.csv and poses.tum; empty: no such files.
  std::vector<double> times;
  PoseGraph graph;                  ///< for graph.g2o; empty: no such file
  std::string memory;               ///< packedMemory(), for map.slam; empty: no such file
  std::string replay;               ///< Replay::packed(), for replay.html; empty: no such file
  std::vector<std::string> beside;  ///< names of files that the run has written there itself
  /// Goes into summary.json, in this order, followed by the map's own numbers.
  nlohmann::ordered_json summary = nlohmann::ordered_json::object();
};

/// What a mapping session has made: lines, poly-lines, arcs, the trajectory of its drive and its
/// times. @param title  for people.
MapProducts mapProducts(const std::string& title, const MappingSession& session);

/// Writes a map's folder: lines.csv, arcs.csv, lines.geojson, lines.svg, lines.dxf, map.png,
/// map.pgm and map.yaml, map.gridmap.gz, map.linemap.gz, scene.3Dscene, poses.csv, poses.tum,
/// graph.g2o, map.slam, replay.html, summary.json (last: where it is, all is there). MRPT's own
/// grid and scene hold single-precision numbers and stay in the products' frame; where that is not
/// the map frame, summary.json has its place as `frame_origin_m`.
///
/// The folder is made where it is missing. Each file appears whole or not at all; those of this
/// list that the products do not hold are removed.
/// @throws std::runtime_error naming the file and the reason.
void writeMapFolder(const std::string& folder, const MapProducts& products);

/// The same map, seen from a frame that lies at p_frame in its own. The grid stays where it is.
MapProducts seenFrom(const Eigen::Vector2d& p_frame, MapProducts products);

}  // namespace cca
