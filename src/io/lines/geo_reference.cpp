// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/geo_reference.hpp"

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace cca {
namespace {

// WGS 84 [NIMA TR8350.2].
constexpr double kEquator = 6378137.0;  // m, semi-major axis
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kPole = kEquator * (1.0 - kFlattening);  // m, semi-minor axis
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

/// Earth-centred place of a point of the ellipsoid.
Eigen::Vector3d onEllipsoid(double latitude, double longitude) {
  const double s = std::sin(latitude);
  const double normal = kEquator / std::sqrt(1.0 - kEccentricity2 * s * s);
  return {normal * std::cos(latitude) * std::cos(longitude),
          normal * std::cos(latitude) * std::sin(longitude), normal * (1.0 - kEccentricity2) * s};
}

/// Columns: the map's x, its y, and up, Earth-centred.
Eigen::Matrix3d axesOf(const GeoReference& at) {
  const double b = at.latitude_deg * kRadiansPerDegree, l = at.longitude_deg * kRadiansPerDegree;
  const Eigen::Vector3d east(-std::sin(l), std::cos(l), 0.0);
  const Eigen::Vector3d up(std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b));
  const Eigen::Vector3d north = up.cross(east);
  const double c = std::cos(at.turn_deg * kRadiansPerDegree),
               s = std::sin(at.turn_deg * kRadiansPerDegree);
  Eigen::Matrix3d axes;
  axes << c * east + s * north, c * north - s * east, up;
  return axes;
}

Eigen::Vector3d originOf(const GeoReference& at) {
  return onEllipsoid(at.latitude_deg * kRadiansPerDegree, at.longitude_deg * kRadiansPerDegree);
}

std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double number = 0.0;
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc()) return {};
    numbers.push_back(number);
    if (read.ptr == end) return numbers;
    if (*read.ptr != ',') return {};
    at = read.ptr + 1;
  }
}

}  // namespace

Eigen::Vector2d GeoReference::toDegrees(const Eigen::Vector2d& p_map) const {
  const Eigen::Vector3d p = originOf(*this) + axesOf(*this).leftCols<2>() * p_map;
  const double r = p.head<2>().norm();
  // Bowring 1976: near the ellipsoid exact to far below a millimetre, without iteration.
  const double u = std::atan2(p.z() * kEquator, r * kPole);
  const double second = kEccentricity2 / (1.0 - kEccentricity2);
  const double latitude = std::atan2(p.z() + second * kPole * std::pow(std::sin(u), 3),
                                     r - kEccentricity2 * kEquator * std::pow(std::cos(u), 3));
  return Eigen::Vector2d(std::atan2(p.y(), p.x()), latitude) / kRadiansPerDegree;
}

Eigen::Vector2d GeoReference::toMap(const Eigen::Vector2d& longitude_latitude_deg) const {
  const Eigen::Vector2d radians = longitude_latitude_deg * kRadiansPerDegree;
  const Eigen::Vector3d p = onEllipsoid(radians.y(), radians.x()) - originOf(*this);
  return (axesOf(*this).transpose() * p).head<2>();
}

GeoReference geoReferenceOf(const std::string& text) {
  const std::vector<double> numbers = numbersIn(text);
  GeoReference place;
  if (numbers.size() == 2) place = {numbers[0], numbers[1]};
  if (numbers.size() == 3) place = {numbers[0], numbers[1], numbers[2]};
  if (numbers.size() < 2 || numbers.size() > 3 || !place.isOnEarth()) {
    throw std::runtime_error(
        "'" + text +
        "': LAT,LON or LAT,LON,DEG is needed: degrees in [-89.9, 89.9], [-180, 180] and "
        "[-360, 360], the last one how far the map's x axis is turned from "
        "east to the left");
  }
  return place;
}

}  // namespace cca
