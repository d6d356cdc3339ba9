// SPDX-License-Identifier: BSD-3-Clause
#include "slam/likelihood_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "geometry/square_key.hpp"
#include "slam/scan_surface.hpp"

namespace cca {
namespace {

/// The likelihood beside a return, as far as it matters.
class Kernel {
 public:
  constexpr static int kHalf = 3;  // cells: 2.5 deviations; a byte says little beyond
  Kernel() {
    for (int y = -kHalf; y <= kHalf; ++y) {
      for (int x = -kHalf; x <= kHalf; ++x) {
        const double d = std::hypot(x, y) / LikelihoodPyramid::kSigma;
        values_[y + kHalf][x + kHalf] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * d * d)));
      }
    }
  }
  std::uint8_t at(int x, int y) const { return values_[y + kHalf][x + kHalf]; }

 private:
  std::uint8_t values_[2 * kHalf + 1][2 * kHalf + 1];
};

/// Each layer holds what faces within a sector of its direction, so a return is in two.
constexpr int kDirections = 8;
constexpr double kSector = 2.0 * M_PI / kDirections;

}  // namespace

LikelihoodPyramid::LikelihoodPyramid(const std::vector<SurfacePoint>& points,
                                     const Eigen::Vector2d& centre, double reach, int levels,
                                     double cell, Facing facing)
    : cell_(cell), layers_(facing == Facing::kAlike ? kDirections : 1) {
  draw(points, centre, reach);
  for (int level = 1; level <= levels; ++level) addLevel();
}

int LikelihoodPyramid::layerOf(double facing) const {
  if (layers_ == 1) return 0;
  // Of two turns at the most.
  return static_cast<int>(facing / kSector + 2 * kDirections + 0.5) % kDirections;
}

void LikelihoodPyramid::draw(const std::vector<SurfacePoint>& points, const Eigen::Vector2d& centre,
                             double reach) {
  Eigen::Vector2d low = centre, high = centre;
  const auto isNear = [&](const Eigen::Vector2d& p) {
    return (p - centre).cwiseAbs().maxCoeff() <= reach;
  };
  for (const SurfacePoint& point : points) {
    if (!isNear(point.position)) continue;
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  const double border = Kernel::kHalf * cell_;
  low_ = low - Eigen::Vector2d::Constant(border);
  width_ = static_cast<int>((high.x() - low_.x() + border) / cell_) + 2 + kMargin;
  height_ = static_cast<int>((high.y() - low_.y() + border) / cell_) + 2 + kMargin;
  cells_.emplace_back(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                      static_cast<std::size_t>(layers_));
  for (const SurfacePoint& point : points) {
    if (!isNear(point.position)) continue;
    if (layers_ == 1) {
      drawOnce(point.position, 0);
    } else if (!point.normal.isZero()) {
      const int first = static_cast<int>(std::floor(bearingOf(point.normal) / kSector));
      for (const int sector : {first, first + 1}) {
        drawOnce(point.position, layerOf(sector * kSector));
      }
    }
  }
}

void LikelihoodPyramid::drawOnce(const Eigen::Vector2d& position, int layer) {
  static const Kernel kernel;
  const Eigen::Vector2d at = toCells(position);
  const int cx = static_cast<int>(at.x()) + kMargin;
  const int cy = static_cast<int>(at.y()) + kMargin + layer * height_;
  const std::size_t width = static_cast<std::size_t>(width_);
  std::vector<std::uint8_t>& finest = cells_.front();
  if (finest[static_cast<std::size_t>(cy) * width + static_cast<std::size_t>(cx)] == 255) return;
  for (int y = -Kernel::kHalf; y <= Kernel::kHalf; ++y) {
    std::uint8_t* row = &finest[static_cast<std::size_t>(cy + y) * width];
    for (int x = -Kernel::kHalf; x <= Kernel::kHalf; ++x) {
      std::uint8_t& value = row[cx + x];
      value = std::max(value, kernel.at(x, y));
    }
  }
}

/// The next coarser one. Between the layers lies a margin that is wider than a coarse cell.
void LikelihoodPyramid::addLevel() {
  const std::size_t width = static_cast<std::size_t>(width_);
  const int rows = layers_ * height_;
  const std::vector<std::uint8_t>& finer = cells_.back();
  std::vector<std::uint8_t> coarser(finer.size());
  const int half = 1 << (levels() - 1);
  for (int y = 0; y < rows; ++y) {
    const std::uint8_t* here = &finer[static_cast<std::size_t>(y) * width];
    const std::uint8_t* there =
        y + half < rows ? here + static_cast<std::size_t>(half) * width : here;
    std::uint8_t* out = &coarser[static_cast<std::size_t>(y) * width];
    for (int x = 0; x < width_ - half; ++x) {
      out[x] = std::max(std::max(here[x], here[x + half]), std::max(there[x], there[x + half]));
    }
    for (int x = std::max(0, width_ - half); x < width_; ++x) out[x] = std::max(here[x], there[x]);
  }
  cells_.push_back(std::move(coarser));
}

std::vector<SurfacePoint> thinned(const std::vector<SurfacePoint>& points, double spacing) {
  std::unordered_set<std::int64_t> taken;
  taken.reserve(points.size());
  std::vector<SurfacePoint> kept;
  for (const SurfacePoint& p : points) {
    if (taken.insert(squareKey(p.position, spacing)).second) kept.push_back(p);
  }
  return kept;
}

}  // namespace cca
