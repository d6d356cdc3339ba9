// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/lines/geo_positions.hpp"
#include "io/lines/line_formats.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

Json feature(Json properties, Json coordinates) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "LineString"}, {"coordinates", std::move(coordinates)}}}};
}

Json lineFeature(const MapLine& line, const GeoPositions& position) {
  const Eigen::Matrix2d& c = line.segment.covariance;
  return feature({{"kind", "line"},
                  {"id", line.id},
                  {"support", line.support},
                  {"share", inTenthousandths(line.share)},
                  {"line_kind", nameOf(line.kind)},
                  {"length", inTenthousandths(line.segment.length())},
                  {"covariance", {c(0, 0), c(0, 1), c(1, 1)}}},
                 Json::array({position(line.segment.start), position(line.segment.end)}));
}

Json polyLineFeature(const PolyLine& chain, const GeoPositions& position) {
  Json coordinates = Json::array();
  double length = 0.0;
  for (std::size_t k = 0; k < chain.vertices.size(); ++k) {
    coordinates.push_back(position(chain.vertices[k]));
    if (k > 0) length += (chain.vertices[k] - chain.vertices[k - 1]).norm();
  }
  return feature(
      {{"kind", "poly_line"}, {"length", inTenthousandths(length)}, {"line_ids", chain.line_ids}},
      std::move(coordinates));
}

Json arcFeature(const MapArc& found, const GeoPositions& position) {
  const Arc& arc = found.arc;
  constexpr double kStep = 5.0 * M_PI / 180.0;
  const int steps = std::max(1, static_cast<int>(std::ceil(arc.sweep / kStep)));
  Json coordinates = Json::array();
  for (int i = 0; i <= steps; ++i) {
    coordinates.push_back(position(arc.at(static_cast<double>(i) / steps)));
  }
  return feature({{"kind", "arc"},
                  {"centre", inTenthousandths(arc.centre)},
                  {"radius", inTenthousandths(arc.radius)},
                  {"start_deg", inTenthousandths(arc.start_angle * kDegreesPerRadian)},
                  {"sweep_deg", inTenthousandths(arc.sweep * kDegreesPerRadian)},
                  {"line_ids", found.line_ids}},
                 std::move(coordinates));
}

Json trajectoryFeature(const std::vector<Pose2>& trajectory, const GeoPositions& position) {
  Json coordinates = Json::array();
  for (const Pose2& pose : trajectory) coordinates.push_back(position(pose.position()));
  return feature({{"kind", "trajectory"}}, std::move(coordinates));
}

/// m, map frame.
std::vector<Eigen::Vector2d> vertices(const Json& feature,
                                      const std::optional<GeoReference>& place) {
  std::vector<Eigen::Vector2d> vertices;
  for (const Json& p : feature.at("geometry").at("coordinates")) {
    const Eigen::Vector2d written(p.at(0).get<double>(), p.at(1).get<double>());
    vertices.push_back(place ? place->toMap(written) : written);
  }
  return vertices;
}

std::vector<Pose2> alongTheWay(const std::vector<Eigen::Vector2d>& positions) {
  std::vector<Pose2> poses;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const Eigen::Vector2d step = k > 0 ? positions[k] - positions[k - 1] : Eigen::Vector2d(0, 0);
    const double before = k > 0 ? poses.back().theta : 0.0;
    const double heading = step.isZero() ? before : std::atan2(step.y(), step.x());
    poses.push_back({positions[k].x(), positions[k].y(), heading});
  }
  return poses;
}

}  // namespace

std::string linesGeoJson(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                         const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs,
                         const std::optional<GeoReference>& place) {
  const GeoPositions position(place);
  std::vector<Json> features;
  for (const MapLine& line : lines) features.push_back(lineFeature(line, position));
  for (const PolyLine& chain : poly_lines) features.push_back(polyLineFeature(chain, position));
  for (const MapArc& arc : arcs) features.push_back(arcFeature(arc, position));
  if (trajectory.size() > 1) features.push_back(trajectoryFeature(trajectory, position));
  return position.collection(features);
}

ChainsAndTrajectory readLinesGeoJson(const std::string& text, const std::string& name) try {
  ChainsAndTrajectory read;
  const Json collection = Json::parse(text);
  std::optional<GeoReference> place;
  if (collection.contains("origin")) {
    const Json& origin = collection.at("origin");
    place = {origin.at(0).get<double>(), origin.at(1).get<double>(), origin.at(2).get<double>()};
  }
  for (const Json& feature : collection.at("features")) {
    const Json& properties = feature.at("properties");
    const std::string kind = properties.at("kind");
    if (kind == "poly_line") {
      read.poly_lines.push_back(
          {vertices(feature, place), properties.at("line_ids").get<std::vector<std::uint64_t>>()});
    } else if (kind == "trajectory") {
      read.trajectory = alongTheWay(vertices(feature, place));
    }
  }
  return read;
} catch (const nlohmann::json::exception& error) {
  throw std::runtime_error(name + ": not a line map's GeoJSON: " + error.what());
}

}  // namespace cca
