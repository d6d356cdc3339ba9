// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/polygon_measures.hpp"

// Coordinates in metres need no rescaling to whole numbers.
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

namespace cca {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, false, true>;  // counter-clockwise, closed

BoostPolygon toBoost(const Polygon& outline, const std::vector<Polygon>& holes) {
  BoostPolygon polygon;
  for (const auto& p : outline) bg::append(polygon.outer(), BoostPoint(p.x(), p.y()));
  polygon.inners().resize(holes.size());
  for (std::size_t k = 0; k < holes.size(); ++k) {
    for (const auto& p : holes[k]) bg::append(polygon.inners()[k], BoostPoint(p.x(), p.y()));
  }
  bg::correct(polygon);  // closes the rings
  return polygon;
}

}  // namespace

bool isValidPolygon(const Polygon& outline, const std::vector<Polygon>& holes) {
  return outline.size() >= 3 && bg::is_valid(toBoost(outline, holes));
}

double areaOf(const Polygon& outline, const std::vector<Polygon>& holes) {
  return bg::area(toBoost(outline, holes));
}

double perimeterOf(const Polygon& outline, const std::vector<Polygon>& holes) {
  return bg::perimeter(toBoost(outline, holes));
}

}  // namespace cca
