// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/configuration_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cca {
namespace {

constexpr double kSlide = 0.01;  // m, how much deeper a slide along a disc may lead
constexpr double kTouch = 1e-9;  // m

// The radius of a disc as seen from a place at this distance from its centre.
double discRadius(double radius, double distance) {
  return distance >= radius ? radius : std::max(0.0, distance - kSlide);
}

}  // namespace

double ConfigurationSpace::freeDistance(const Eigen::Vector2d& from,
                                        const Eigen::Vector2d& direction, double longest) const {
  double free = longest;
  for (const Eigen::Vector2d& p : obstacles) {
    const Eigen::Vector2d to = p - from;
    const double ahead = to.dot(direction);
    if (ahead <= 0.0 || ahead - radius >= free) continue;
    const double squared = to.squaredNorm();
    const double disc = squared < radius * radius ? discRadius(radius, std::sqrt(squared)) : radius;
    const double inside = disc * disc - (squared - ahead * ahead);
    if (inside > 0.0) free = std::min(free, std::max(0.0, ahead - std::sqrt(inside)));
  }
  return free;
}

std::vector<FreeRange> ConfigurationSpace::freeRanges(const Eigen::Vector2d& from, int bearings,
                                                      double longest) const {
  std::vector<FreeRange> ranges(static_cast<std::size_t>(bearings), {longest, -1});
  const double step = 2.0 * M_PI / bearings;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Eigen::Vector2d to = obstacles[i] - from;
    const double distance = to.norm();
    const double disc = discRadius(radius, distance);
    if (distance - disc >= longest || disc == 0.0) continue;
    const double bearing = std::atan2(to.y(), to.x());
    const double half = std::asin(disc / distance);
    const int last = static_cast<int>(std::floor((bearing + half) / step));
    for (int k = static_cast<int>(std::ceil((bearing - half) / step)); k <= last; ++k) {
      FreeRange& range = ranges[static_cast<std::size_t>((k % bearings + bearings) % bearings)];
      if (range.distance < distance - disc - kTouch) continue;  // nearer than the whole disc
      const double off = k * step - bearing;
      const double aside = distance * std::sin(off);
      const double inside = disc * disc - aside * aside;
      if (inside < 0.0) continue;
      const double free = std::max(0.0, distance * std::cos(off) - std::sqrt(inside));
      if (free < range.distance) range = {free, static_cast<int>(i)};
    }
  }
  return ranges;
}

bool ConfigurationSpace::isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double length = (to - from).norm();
  return length == 0.0 || freeDistance(from, (to - from) / length, length) >= length;
}

double ConfigurationSpace::clearance(const Eigen::Vector2d& p_map) const {
  double squared = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& p : obstacles) squared = std::min(squared, (p - p_map).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace cca
