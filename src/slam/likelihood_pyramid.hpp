// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cca {

/// A return, and the direction that its surface faces; zero where none is known.
struct SurfacePoint {
  Eigen::Vector2d position;                          ///< m
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit
};

/// How likely a return is at each place near some surfaces: 255 on a return, falling with the
/// distance from it as a Gaussian. Coarser levels hold, for a cell, the largest value of the
/// 2^level x 2^level cells that begin there, so that none is missed [Hess et al. 2016].
class LikelihoodPyramid {
 public:
  /// Whether a return has to face as the surface does.
  enum class Facing { kAny, kAlike };

  /// @param points  map frame; the grid covers these within `reach` [m] of `centre`.
  /// @param levels  how many besides the finest.
  /// @param cell    m, of the finest; the Gaussian's deviation is kSigma of it.
  /// @param facing  kAlike: a layer for each of eight directions, of the returns that face within
  ///                45 degrees of it; those that face nowhere are in none.
  LikelihoodPyramid(const std::vector<SurfacePoint>& points, const Eigen::Vector2d& centre,
                    double reach, int levels, double cell, Facing facing = Facing::kAny);
  static constexpr double kSigma = 1.2;  ///< cells: the next cell still holds 0.7

  double cell() const { return cell_; }  ///< m

  int levels() const { return static_cast<int>(cells_.size()); }
  /// The layer that a return of this direction [rad] is looked up in.
  int layerOf(double facing) const;
  /// The value that cell (x, y) of a level holds in a layer; 0 outside.
  std::uint8_t at(int level, int layer, int x, int y) const {
    x += kMargin;
    y += kMargin;
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
    return cells_[static_cast<std::size_t>(level)]
                 [static_cast<std::size_t>(layer * height_ + y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)];
  }
  /// A cell of a layer as a distance from cell (0, 0) of the first one, in each level: that of the
  /// cell x, y beside it is offset(x, y, 0) more.
  int offset(int x, int y, int layer) const { return (layer * height_ + y) * width_ + x; }
  /// Whether at() holds something for all cells from (low_x, low_y) to (high_x, high_y).
  bool covers(int low_x, int low_y, int high_x, int high_y) const {
    return low_x >= -kMargin && low_y >= -kMargin && high_x < width_ - kMargin &&
           high_y < height_ - kMargin;
  }
  /// Cell (0, 0) of the first layer of a level; others by offset(), where it covers() them.
  const std::uint8_t* level(int level) const {
    return cells_[static_cast<std::size_t>(level)].data() + kMargin * width_ + kMargin;
  }
  /// In units of cells.
  Eigen::Vector2d toCells(const Eigen::Vector2d& p_map) const { return (p_map - low_) / cell_; }

 private:
  void draw(const std::vector<SurfacePoint>& points, const Eigen::Vector2d& centre, double reach);
  void drawOnce(const Eigen::Vector2d& position, int layer);
  void addLevel();
  // A coarse cell may begin up to 2^level - 1 cells before the first fine one.
  static constexpr int kMargin = 64;
  double cell_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int layers_ = 1;
  int width_ = 0, height_ = 0;                    // of a layer
  std::vector<std::vector<std::uint8_t>> cells_;  // of each level, a layer upon the other
};

/// Points at least `spacing` [m] apart, in the order given.
std::vector<SurfacePoint> thinned(const std::vector<SurfacePoint>& points, double spacing);

}  // namespace cca
