// SPDX-License-Identifier: BSD-3-Clause
#include "io/lines/geo_positions.hpp"

#include <cmath>

namespace cca {

using Json = nlohmann::ordered_json;

double inTenthousandths(double value) { return std::round(value * 1e4) / 1e4; }

Json inTenthousandths(const Eigen::Vector2d& p) {
  return {inTenthousandths(p.x()), inTenthousandths(p.y())};
}

Json GeoPositions::operator()(const Eigen::Vector2d& p) const {
  if (!place_) return inTenthousandths(p);
  const Eigen::Vector2d degrees = place_->toDegrees(p);
  constexpr double kDigits = 1e9;  // a degree is 111 km: again a tenth of a millimetre
  return {std::round(degrees.x() * kDigits) / kDigits, std::round(degrees.y() * kDigits) / kDigits};
}

std::string GeoPositions::collection(const std::vector<Json>& features) const {
  const Json where =
      place_ ? Json{{"origin", {place_->latitude_deg, place_->longitude_deg, place_->turn_deg}}}
             : Json{{"note", "metres of the map frame, not longitude and latitude"}};
  const std::string told = where.dump();
  std::string text =
      "{\"type\": \"FeatureCollection\", " + told.substr(1, told.size() - 2) + ", \"features\": [";
  const char* separator = "\n";
  for (const Json& feature : features) {
    text += separator + feature.dump(-1, ' ', false, Json::error_handler_t::replace);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace cca
