// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "cca_mrpt/navigation/goals/view_points.hpp"
#include "cca_mrpt/navigation/place/grid_paths.hpp"

namespace cca {

/// The best open tours from a start through all stops, exactly, one for each stop that it may begin
/// with [Held & Karp 1962].
///
/// A tour costs length + sum_k urgency_k * arrival_k, where arrival_k is the way to stop k along
/// it: without urgency it is the travelling salesman's, with much of it the travelling repairman's,
/// who serves the most urgent stops early.
/// @param distance  (n + 1) x (n + 1), metres; row and column 0 are the start, k + 1 is stop k.
/// @param urgency   of the n stops, >= 0.
/// @return  what each costs, by its first stop. Cost: O(2^n n^2).
std::vector<double> tourCosts(const Eigen::MatrixXd& distance, const std::vector<double>& urgency);

struct ViewTourParameters {
  /// Weight of the gain-weighted mean arrival against the length of the tour. Measured on the
  /// worlds: 0 (shortest tour) is late at 90 % coverage, 30 leaves too many rests behind.
  double hurry = 10.0;
  int fields_per_choice = 2;  ///< distance fields computed anew at most, each choice
};

/// Our own way to choose the next goal, where no frontier promises so much that it is driven into:
/// the first stop of a tour that sees everything soon.
///
/// 1. Few view points that see all frontiers between them are kept (greedy set cover).
/// 2. The best open tour through them is found, the more urgent a stop the more it shows.
/// 3. The tour that begins with the present goal is kept unless another is clearly cheaper.
class ViewTour {
 public:
  explicit ViewTour(const ViewTourParameters& parameters = {}) : parameters_(parameters) {}

  /// @param view_points  with distances from the robot and gains.
  /// @param reach        m, how far the robot sees.
  /// @param present      target of the present goal, if it still stands.
  /// @return             index of the view point to go to; empty where there is none.
  /// Cost: O(n^2 reach) lines of sight for n view points, and a few distance fields.
  std::optional<std::size_t> choose(const ExplorationGrid& grid, const FreeSpace& space,
                                    const std::vector<ViewPoint>& view_points, double reach,
                                    std::optional<Cell> present);

  /// Finds ways from one of the stops that the last choice had too little time for: the next choice
  /// need not estimate them. For the steps between two choices. Cost: one distance field.
  void prepare(const ExplorationGrid& grid, const FreeSpace& space);

 private:
  struct Stop {
    std::size_t view_point;
    double gain;  ///< m^2, around what it is there to see
    bool sees_present;
  };
  struct CachedField {
    Cell block;
    std::uint32_t made = 0;  ///< number of the choice that computed it
    std::uint32_t used = 0;
    DistanceField field;
  };

  std::vector<Stop> cover(const ExplorationGrid& grid, const std::vector<ViewPoint>& view_points,
                          double reach, std::optional<Cell> present) const;
  Eigen::MatrixXd distances(const ExplorationGrid& grid, const FreeSpace& space,
                            const std::vector<ViewPoint>& view_points,
                            const std::vector<Stop>& stops);
  DistanceField* fieldAt(const ExplorationGrid& grid, const FreeSpace& space, Cell cell,
                         int& budget);

  ViewTourParameters parameters_;
  std::vector<CachedField> fields_;
  std::vector<Cell> last_stops_;
  std::vector<std::size_t> estimated_;  ///< of the last stops, whose ways were only estimated
  std::uint32_t choices_ = 0;
};

}  // namespace cca
