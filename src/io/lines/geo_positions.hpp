// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cca_mrpt/io/geo_reference.hpp"

namespace cca {

/// Positions of GeoJSON: metres of the map frame, or longitude and latitude where the map's place
/// on the Earth is known; to a tenth of a millimetre: more digits would only claim what no laser
/// measures.
class GeoPositions {
 public:
  explicit GeoPositions(const std::optional<GeoReference>& place) : place_(place) {}
  nlohmann::ordered_json operator()(const Eigen::Vector2d& p) const;
  /// The beginning of a FeatureCollection, up to its first feature: how positions are meant.
  std::string head() const;

 private:
  const std::optional<GeoReference>& place_;
};

/// To four digits behind the point: of metres, a tenth of a millimetre.
double inTenthousandths(double value);
nlohmann::ordered_json inTenthousandths(const Eigen::Vector2d& p);

}  // namespace cca
