// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/map_frame.hpp"

#include <algorithm>

#include "io/files/memory_file.hpp"
#include "io/lines/line_formats.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/poses/local_frame.hpp"
#include "io/poses/pose_files.hpp"

namespace cca {

MapProducts mapProducts(const std::string& title, const MappingSession& session) {
  MapProducts products;
  products.title = title;
  products.lines = session.lineMap().lines();
  products.poly_lines = session.lineMap().polyLines();
  products.arcs = session.lineMap().arcs();
  products.trajectory = session.trajectory();
  products.times = session.times();
  return products;
}

MapProducts seenFrom(const Eigen::Vector2d& p_frame, MapProducts products) {
  products.origin += p_frame;
  for (MapLine& line : products.lines) {
    line.segment.start -= p_frame;
    line.segment.end -= p_frame;
    line.segment.moments.mean -= p_frame;
  }
  for (PolyLine& chain : products.poly_lines) {
    for (auto& vertex : chain.vertices) vertex -= p_frame;
  }
  for (MapArc& arc : products.arcs) arc.arc.centre -= p_frame;
  for (Pose2& pose : products.trajectory) pose = seenFrom(p_frame, pose);
  for (int k = 0; k < products.graph.size(); ++k) {
    products.graph.place(k, seenFrom(p_frame, products.graph.pose(k)));
  }
  return products;
}

NamedFiles mapTexts(const MapProducts& map) {
  NamedFiles files{
      {"lines.csv", linesCsv(map.lines)},
      {"arcs.csv", arcsCsv(map.arcs)},
      {"lines.geojson",
       linesGeoJson(map.lines, map.poly_lines, map.trajectory, map.arcs, map.place)},
      {"lines.svg", linesSvg(map.lines, map.poly_lines, map.trajectory, map.arcs, map.place)},
      {"lines.dxf", linesDxf(map.lines, map.poly_lines, map.trajectory, map.arcs)}};
  if (map.grid) {
    files.emplace_back("map.pgm", occupancyPgm(*map.grid));
    files.emplace_back("map.yaml", occupancyYaml(*map.grid, "map.pgm"));
  }
  std::vector<StampedPose> poses;
  for (std::size_t k = 0; k < std::min(map.times.size(), map.trajectory.size()); ++k) {
    poses.push_back({map.times[k], map.trajectory[k]});
  }
  if (!poses.empty()) {
    files.emplace_back("poses.csv", posesCsv(poses));
    files.emplace_back("poses.tum", posesTum(poses));
  }
  if (map.graph.size() > 0) files.emplace_back("graph.g2o", graphG2o(map.graph));
  if (!map.memory.empty()) files.emplace_back(kMemoryFile, map.memory);
  return files;
}

std::vector<PlanRoom> seenFrom(const Eigen::Vector2d& p_frame, std::vector<PlanRoom> rooms) {
  const auto move = [&p_frame](Eigen::Vector2d& p) {
    p = (1e6 * (p - p_frame)).array().round().matrix() / 1e6;
  };
  for (PlanRoom& room : rooms) {
    for (Eigen::Vector2d& p : room.outline) move(p);
    for (Polygon& hole : room.holes) {
      for (Eigen::Vector2d& p : hole) move(p);
    }
    move(room.label);
  }
  return rooms;
}

}  // namespace cca
