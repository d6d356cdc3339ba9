// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "cca_mrpt/io/geo_reference.hpp"
#include "plan_reader_formats.hpp"

namespace cca {
namespace {

/// Of our files: no walls, or told once more.
const std::set<std::string> kNoWalls{"trajectory", "poly_line", "arc", "room", "door", "opening"};

class GeoJsonPlan {
 public:
  /// @param name  of the file, for messages.
  GeoJsonPlan(const nlohmann::json& document, const std::string& name, double scale)
      : scale_(scale > 0.0 ? scale : 1.0) {
    if (document.contains("origin")) {
      if (scale > 0.0) {
        throw std::runtime_error(name + ": is in degrees; a scale is for lengths");
      }
      const auto& origin = document.at("origin");
      place_ = {origin.at(0).get<double>(), origin.at(1).get<double>(), origin.at(2).get<double>()};
    }
    take(document);
    plan_.kind = "GeoJSON";
    plan_.not_understood = inWords(rest_);
  }
  PlanFile plan() { return std::move(plan_); }

 private:
  void take(const nlohmann::json& object) {
    const std::string type = object.at("type");
    if (type == "FeatureCollection") {
      for (const auto& feature : object.at("features")) takeFeature(feature);
    } else if (type == "Feature") {
      takeFeature(object);
    } else {
      takeGeometry(object, 0.0);
    }
  }

  void takeFeature(const nlohmann::json& feature) {
    double thickness = 0.0;
    if (feature.contains("properties") && feature.at("properties").is_object()) {
      const auto& properties = feature.at("properties");
      if (properties.contains("kind") && properties.at("kind").is_string() &&
          kNoWalls.count(properties.at("kind").get<std::string>()) > 0) {
        return;
      }
      const auto found = properties.find("thickness_m");
      if (found != properties.end() && found->is_number()) thickness = found->get<double>();
    }
    if (feature.at("geometry").is_object()) takeGeometry(feature.at("geometry"), thickness);
  }

  void takeGeometry(const nlohmann::json& geometry, double thickness) {
    const std::string type = geometry.at("type");
    if (type == "GeometryCollection") {
      for (const auto& part : geometry.at("geometries")) takeGeometry(part, thickness);
    } else if (type == "LineString") {
      takeChain(geometry.at("coordinates"), thickness);
    } else if (type == "MultiLineString" || type == "Polygon") {
      for (const auto& chain : geometry.at("coordinates")) takeChain(chain, thickness);
    } else if (type == "MultiPolygon") {
      for (const auto& polygon : geometry.at("coordinates")) {
        for (const auto& ring : polygon) takeChain(ring, thickness);
      }
    } else {
      ++rest_[type];
    }
  }

  void takeChain(const nlohmann::json& coordinates, double thickness) {
    std::vector<Eigen::Vector2d> chain;
    for (const auto& p : coordinates) {
      const Eigen::Vector2d told(p.at(0).get<double>(), p.at(1).get<double>());
      chain.push_back(place_ ? place_->toMap(told) : Eigen::Vector2d(scale_ * told));
    }
    if (thickness <= 0.0) return addChain(chain, false, plan_.lines);
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const Eigen::Vector2d along = (chain[k] - chain[k - 1]).normalized();
      const Eigen::Vector2d half = 0.5 * thickness * Eigen::Vector2d(-along.y(), along.x());
      plan_.lines.emplace_back(chain[k - 1] + half, chain[k] + half);
      plan_.lines.emplace_back(chain[k - 1] - half, chain[k] - half);
    }
  }

  double scale_;
  std::optional<GeoReference> place_;
  PlanFile plan_;
  Counts rest_;
};

}  // namespace

PlanFile readGeoJsonPlan(const std::string& text, const std::string& name, double scale) try {
  return GeoJsonPlan(nlohmann::json::parse(text), name, scale).plan();
} catch (const nlohmann::json::exception& error) {
  throw std::runtime_error(name + ": is no GeoJSON (RFC 7946) of lines: " + error.what());
}

}  // namespace cca
