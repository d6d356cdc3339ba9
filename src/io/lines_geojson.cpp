// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "cca_mrpt/io/line_formats.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

/// To a tenth of a millimetre: more digits would only claim what no laser measures.
double rounded(double metres) { return std::round(metres * 1e4) / 1e4; }

Json position(const Eigen::Vector2d& p) { return {rounded(p.x()), rounded(p.y())}; }

Json feature(Json properties, Json coordinates) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "LineString"}, {"coordinates", std::move(coordinates)}}}};
}

Json lineFeature(const MapLine& line) {
  const Eigen::Matrix2d& c = line.segment.covariance;
  return feature({{"kind", "line"},
                  {"id", line.id},
                  {"support", line.support},
                  {"length", rounded(line.segment.length())},
                  {"covariance", {c(0, 0), c(0, 1), c(1, 1)}}},
                 Json::array({position(line.segment.start), position(line.segment.end)}));
}

Json polyLineFeature(const PolyLine& chain) {
  Json coordinates = Json::array();
  double length = 0.0;
  for (std::size_t k = 0; k < chain.vertices.size(); ++k) {
    coordinates.push_back(position(chain.vertices[k]));
    if (k > 0) length += (chain.vertices[k] - chain.vertices[k - 1]).norm();
  }
  return feature({{"kind", "poly_line"}, {"length", rounded(length)}, {"line_ids", chain.line_ids}},
                 std::move(coordinates));
}

}  // namespace

std::string linesGeoJson(const std::vector<MapLine>& lines,
                         const std::vector<PolyLine>& poly_lines) {
  // One feature a row: such files are looked at, and compared, line by line.
  std::string text = "{\"type\": \"FeatureCollection\", \"features\": [";
  const char* separator = "\n";
  const auto append = [&](const Json& next) {
    text += separator + next.dump();
    separator = ",\n";
  };
  for (const MapLine& line : lines) append(lineFeature(line));
  for (const PolyLine& chain : poly_lines) append(polyLineFeature(chain));
  return text + "\n]}\n";
}

}  // namespace cca
