// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cca_mrpt/simulation/building.hpp"
#include "geometry/cross.hpp"

namespace cca {

namespace {

constexpr double kJust = 1e-5;      // m, 'just in front of' a face
constexpr double kShortest = 1e-4;  // m, below this a piece is rounding

/// Cells that a point can get to from the plan's start.
std::vector<char> floodFromStart(const World& world) {
  std::vector<char> reached(static_cast<std::size_t>(world.width()) * world.height(), 0);
  const Eigen::Vector2d start = world.toCells(world.start->position());
  std::vector<std::pair<int, int>> open{{static_cast<int>(start.x()), static_cast<int>(start.y())}};
  while (!open.empty()) {
    const auto [ix, iy] = open.back();
    open.pop_back();
    if (world.isObstacle(ix, iy)) continue;
    char& cell = reached[static_cast<std::size_t>(iy) * world.width() + ix];
    if (cell) continue;
    cell = 1;
    open.insert(open.end(), {{ix + 1, iy}, {ix - 1, iy}, {ix, iy + 1}, {ix, iy - 1}});
  }
  return reached;
}

/// Where along the edge a -> b (0 to 1) it meets or leaves edges of other solids.
std::vector<double> cutsAlong(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                              const std::vector<Polygon>& solids) {
  const Eigen::Vector2d edge = b - a;
  const double length = edge.norm();
  std::vector<double> cuts{0.0, 1.0};
  const auto cut = [&cuts](double t) {
    if (t > 0.0 && t < 1.0) cuts.push_back(t);
  };
  for (const Polygon& solid : solids) {
    for (std::size_t i = 0; i < solid.size(); ++i) {
      const Eigen::Vector2d &c = solid[i], &d = solid[(i + 1) % solid.size()];
      const Eigen::Vector2d other = d - c;
      const double across = cross(edge, other);
      if (std::abs(across) > 1e-9 * length * other.norm()) {
        const double t = cross(c - a, other) / across, s = cross(c - a, edge) / across;
        if (s >= -1e-9 && s <= 1.0 + 1e-9) cut(t);
      } else if (std::abs(cross(edge, c - a)) < kJust * length) {  // along the same line
        cut((c - a).dot(edge) / (length * length));
        cut((d - a).dot(edge) / (length * length));
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

class FreeSide {
 public:
  FreeSide(const Building& plan, double resolution)
      : plan_(plan), world_(rasterise(plan, resolution)), reached_(floodFromStart(world_)) {}

  /// Whether the place just in front of a face is free, and open to the start.
  bool holds(const Eigen::Vector2d& middle, const Eigen::Vector2d& outwards) const {
    const Eigen::Vector2d front = middle + kJust * outwards;
    for (const Polygon& solid : plan_.solids) {
      if (isInside(solid, front)) return false;
    }
    const Eigen::Vector2d cell = world_.toCells(middle + world_.resolution() * outwards);
    const int cx = static_cast<int>(std::floor(cell.x()));
    const int cy = static_cast<int>(std::floor(cell.y()));
    for (int iy = cy - 1; iy <= cy + 1; ++iy) {  // the raster is off by up to a cell
      for (int ix = cx - 1; ix <= cx + 1; ++ix) {
        if (!world_.isObstacle(ix, iy) &&
            reached_[static_cast<std::size_t>(iy) * world_.width() + ix]) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  const Building& plan_;
  World world_;
  std::vector<char> reached_;
};

/// Joins faces that continue each other in a straight line, and drops doubles.
std::vector<WallFace> joined(std::vector<WallFace> faces) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t j = i + 1; j < faces.size(); ++j) {
        auto& [a, b] = faces[i];
        const auto& [c, d] = faces[j];
        const Eigen::Vector2d along = (b - a).normalized();
        if ((d - c).normalized().dot(along) < 1.0 - 1e-9) continue;  // other way: other side
        if (std::abs(cross(along, c - a)) > kJust || std::abs(cross(along, d - a)) > kJust) {
          continue;
        }
        const double length = (b - a).norm(), from = (c - a).dot(along), to = (d - a).dot(along);
        if (from > length + kShortest || to < -kShortest) continue;
        const Eigen::Vector2d start = from < 0.0 ? c : a, end = to > length ? d : b;
        faces[i] = {start, end};
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(j));
        changed = true;
        --j;
      }
    }
  }
  return faces;
}

}  // namespace

std::vector<WallFace> wallFaces(const Building& plan, double resolution) {
  const FreeSide free_side(plan, resolution);
  std::vector<WallFace> faces;
  for (const Polygon& solid : plan.solids) {
    for (std::size_t i = 0; i < solid.size(); ++i) {
      const Eigen::Vector2d &a = solid[i], &b = solid[(i + 1) % solid.size()];
      const Eigen::Vector2d edge = b - a;
      const Eigen::Vector2d outwards = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
      const auto cuts = cutsAlong(a, b, plan.solids);
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const Eigen::Vector2d from = a + cuts[k] * edge, to = a + cuts[k + 1] * edge;
        if ((to - from).norm() < kShortest) continue;
        if (free_side.holds(0.5 * (from + to), outwards)) faces.emplace_back(from, to);
      }
    }
  }
  return joined(std::move(faces));
}

}  // namespace cca
