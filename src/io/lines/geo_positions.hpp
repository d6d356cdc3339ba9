// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/geo_reference.hpp"

namespace cca {

/// Positions of GeoJSON: metres of the map frame, or longitude and latitude where the map's place
/// on the Earth is known; to a tenth of a millimetre: more digits would only claim what no laser
/// measures.
class GeoPositions {
 public:
  explicit GeoPositions(const std::optional<GeoReference>& place) : place_(place) {}
  nlohmann::ordered_json operator()(const Eigen::Vector2d& p) const;
  /// A FeatureCollection of these, which tells how positions are meant; a row for each feature:
  /// such files are looked at, and compared, line by line.
  std::string collection(const std::vector<nlohmann::ordered_json>& features) const;

 private:
  const std::optional<GeoReference>& place_;
};

/// To four digits behind the point: of metres, a tenth of a millimetre.
double inTenthousandths(double value);
nlohmann::ordered_json inTenthousandths(const Eigen::Vector2d& p);

}  // namespace cca
