// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "cca_mrpt/slam/surface_matching.hpp"

namespace cca {

/// How likely a return is at each place near some surfaces: 255 on a return, falling with the
/// distance from it as a Gaussian. Coarser levels hold, for a cell, the largest value of the
/// 2^level x 2^level cells that begin there, so that none is missed [Hess et al. 2016].
class LikelihoodPyramid {
 public:
  /// @param points  m, map frame; the grid covers these within `reach` [m] of `centre`.
  /// @param levels  how many besides the finest.
  /// @param cell    m, of the finest; the Gaussian's deviation is kSigma of it.
  LikelihoodPyramid(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& centre,
                    double reach, int levels, double cell);
  static constexpr double kSigma = 1.2;

  double cell() const { return cell_; }  ///< m

  int levels() const { return static_cast<int>(cells_.size()); }
  /// The value that cell (x, y) of a level holds; 0 outside.
  std::uint8_t at(int level, int x, int y) const {
    x += kMargin;
    y += kMargin;
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
    return cells_[static_cast<std::size_t>(level)]
                 [static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)];
  }
  /// In units of cells.
  Eigen::Vector2d toCells(const Eigen::Vector2d& p_map) const { return (p_map - low_) / cell_; }

 private:
  // A coarse cell may begin up to 2^level - 1 cells before the first fine one.
  static constexpr int kMargin = 64;
  double cell_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  std::vector<std::vector<std::uint8_t>> cells_;
};

/// Where to search: about `centre`, within these half widths.
struct SearchWindow {
  Pose2 centre;
  double half_width = 1.0;  ///< m, in x and y
  double half_turn = 0.2;   ///< rad
  /// What a pose off the centre has to make up for: a prior of this information (diagonal, in the
  /// map's axes), in units of the mean likelihood by `prior_weight`. Its tails are those of
  /// Student's t: wheels slip.
  Eigen::Vector3d prior_information = Eigen::Vector3d::Zero();
  double prior_weight = 0.0;
  /// Poses this near (m, and rad) to `excluded` are passed over.
  std::optional<Pose2> excluded;
  double excluded_distance = 0.0, excluded_turn = 0.0;
};

struct SearchResult {
  Pose2 T_map_query;
  double score = 0.0;  ///< mean likelihood of the query's points, in [0, 1], without the prior
};

/// The pose with the best mean likelihood of the query's points in a window, less the prior's
/// penalty: exact to the grid, by branch and bound [Hess et al. 2016; Olson 2009].
/// @param query        m, sensor frame.
/// @param least_score  what scores less is not found.
/// @return             nothing where no pose scores more.
std::optional<SearchResult> searchPose(const std::vector<Eigen::Vector2d>& query,
                                       const LikelihoodPyramid& pyramid, const SearchWindow& window,
                                       double least_score);

/// Points at least `spacing` [m] apart, in the order given.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double spacing);

}  // namespace cca
