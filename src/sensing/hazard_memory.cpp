// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/hazard_memory.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kSame = 0.05;     // m: the same as the cells that ways are planned on
constexpr double kFarthest = 1e6;  // m, from the origin of any frame

std::pair<int, int> squareOf(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::floor(p.x() / kSame)), static_cast<int>(std::floor(p.y() / kSame))};
}

}  // namespace

void HazardMemory::add(const std::vector<Eigen::Vector2d>& points, double time) {
  for (const Eigen::Vector2d& p : points) {
    if (!(p.cwiseAbs().maxCoeff() < kFarthest)) continue;
    points_[squareOf(p)] = {p, time};
  }
}

std::vector<Eigen::Vector2d> HazardMemory::around(const Eigen::Vector2d& robot, double time) {
  std::vector<Eigen::Vector2d> near;
  for (auto it = points_.begin(); it != points_.end();) {
    const Point& point = it->second;
    if (std::abs(time - point.time) > kAge || !((point.p - robot).norm() <= kReach)) {
      it = points_.erase(it);
      continue;
    }
    near.push_back(point.p);
    ++it;
  }
  return near;
}

void HazardMemory::move(const Pose2& T_now_was) {
  std::map<std::pair<int, int>, Point> moved;
  for (const auto& [square, point] : points_) {
    const Eigen::Vector2d p = T_now_was * point.p;
    moved[squareOf(p)] = {p, point.time};
  }
  points_ = std::move(moved);
}

}  // namespace cca
