// SPDX-License-Identifier: BSD-3-Clause
#include "tour_left.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace cca::apps {
namespace {

constexpr double kSpacing = 2.0;  // m, what one look covers at least
constexpr double kDetour = 4.0 / 3.0;

}  // namespace

double tourLeft(const Eigen::Vector2d& p_robot, const std::vector<Eigen::Vector2d>& places) {
  std::set<std::pair<long, long>> taken;
  std::vector<Eigen::Vector2d> left;
  for (const auto& place : places) {
    const Eigen::Vector2d cell = (place / kSpacing).array().floor();
    if (taken.emplace(std::lround(cell.x()), std::lround(cell.y())).second) left.push_back(place);
  }
  Eigen::Vector2d at = p_robot;
  double length = 0.0;
  while (!left.empty()) {
    const auto nearest =
        std::min_element(left.begin(), left.end(), [&](const auto& a, const auto& b) {
          return (a - at).squaredNorm() < (b - at).squaredNorm();
        });
    length += (*nearest - at).norm();
    at = *nearest;
    *nearest = left.back();
    left.pop_back();
  }
  return kDetour * length;
}

}  // namespace cca::apps
