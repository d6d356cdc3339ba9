// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/tour.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace cca::evidence {
namespace {

constexpr int kNobody = -1;

/// The places where the robot can stand, and what of them the way has passed.
class Ground {
 public:
  Ground(const World& world, const TourParameters& p) : world_(world), p_(p) {
    width_ = static_cast<int>(world.width() * world.resolution() / p.cell) + 1;
    height_ = static_cast<int>(world.height() * world.resolution() / p.cell) + 1;
    free_.resize(static_cast<std::size_t>(width_) * height_);
    for (int cell = 0; cell < width_ * height_; ++cell) {
      free_[cell] = world.clearance(place(cell), p.clearance) >= p.clearance;
    }
    passed_.assign(free_.size(), false);
  }

  Eigen::Vector2d place(int cell) const {
    return world_.origin() + p_.cell * Eigen::Vector2d(cell % width_ + 0.5, cell / width_ + 0.5);
  }

  /// The free cell nearest to a point.
  int cellAt(const Eigen::Vector2d& p_map) const {
    int nearest = kNobody;
    for (int cell = 0; cell < width_ * height_; ++cell) {
      if (!free_[cell]) continue;
      const double distance = (place(cell) - p_map).norm();
      if (nearest == kNobody || distance < (place(nearest) - p_map).norm()) nearest = cell;
    }
    return nearest;
  }

  void pass(int cell) {
    const int reach = static_cast<int>(p_.reach / p_.cell);
    const int x = cell % width_, y = cell / width_;
    for (int iy = std::max(0, y - reach); iy <= std::min(height_ - 1, y + reach); ++iy) {
      for (int ix = std::max(0, x - reach); ix <= std::min(width_ - 1, x + reach); ++ix) {
        if (std::hypot(ix - x, iy - y) <= reach) passed_[iy * width_ + ix] = true;
      }
    }
  }

  /// The way to the nearest free cell that has not been passed: breadth first; empty: none is left.
  std::vector<int> wayToNearestNew(int from) const {
    std::vector<int> parent(free_.size(), kNobody);
    std::queue<int> open;
    parent[from] = from;
    open.push(from);
    while (!open.empty()) {
      const int cell = open.front();
      open.pop();
      if (!passed_[cell]) return wayBack(parent, cell);
      for (const int next : neighbours(cell)) {
        if (!free_[next] || parent[next] != kNobody) continue;
        parent[next] = cell;
        open.push(next);
      }
    }
    return {};
  }

 private:
  std::vector<int> neighbours(int cell) const {
    const int x = cell % width_, y = cell / width_;
    std::vector<int> found;
    if (x > 0) found.push_back(cell - 1);
    if (x + 1 < width_) found.push_back(cell + 1);
    if (y > 0) found.push_back(cell - width_);
    if (y + 1 < height_) found.push_back(cell + width_);
    return found;
  }

  static std::vector<int> wayBack(const std::vector<int>& parent, int cell) {
    std::vector<int> way{cell};
    while (parent[cell] != cell) way.push_back(cell = parent[cell]);
    std::reverse(way.begin(), way.end());
    return way;
  }

  const World& world_;
  const TourParameters& p_;
  int width_ = 0, height_ = 0;
  std::vector<bool> free_, passed_;
};

}  // namespace

std::vector<Pose2> tour(const World& world, std::size_t most_poses, const TourParameters& p) {
  Ground ground(world, p);
  int here = ground.cellAt(defaultStart(world, p.clearance).position());
  std::vector<Pose2> poses;
  if (here == kNobody) return poses;
  Eigen::Vector2d last = ground.place(here);
  poses.push_back({last.x(), last.y(), 0.0});
  ground.pass(here);
  while (true) {
    const std::vector<int> way = ground.wayToNearestNew(here);
    if (way.empty()) return poses;
    for (const int cell : way) {
      if (poses.size() >= most_poses) return poses;
      here = cell;
      ground.pass(cell);
      const Eigen::Vector2d along = ground.place(cell) - last;
      if (along.norm() < p.step) continue;
      last = ground.place(cell);
      poses.push_back({last.x(), last.y(), std::atan2(along.y(), along.x())});
    }
  }
}

}  // namespace cca::evidence
