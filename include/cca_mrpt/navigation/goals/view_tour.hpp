// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "cca_mrpt/navigation/goals/view_points.hpp"
#include "cca_mrpt/navigation/place/grid_paths.hpp"

namespace cca {

/// What a tour is worth: of each leg, exp(-discount * way) times the worth of its stop and of all
/// that comes after it, less price * way. With a price alone it is the worth of the stops less the
/// length of the tour, which leaves out what is not worth its way; with a discount alone what is
/// worth much comes early, unless much else lies beside the way there.
struct TourObjective {
  std::vector<double> worth;  ///< of the stops; -inf: never to be visited
  double discount = 0.0;      ///< 1/m
  double price = 0.0;         ///< of a metre

  /// Before a leg, of what it leads to. @param way  m.
  double before(double way, double worth_there) const;
};

struct Tour {
  std::vector<std::size_t> stops;  ///< in order, none twice
  double worth = 0.0;
};

/// The best open tours from a start, exactly, one for each stop that it may begin with [Held & Karp
/// 1962]. Each ends where going on is worth nothing.
///
/// @param distance  (n + 1) x (n + 1), metres, finite; row and column 0 are the start, k + 1 is
///                  stop k.
/// @return          by first stop. Cost: O(2^n n^2).
std::vector<Tour> findTours(const Eigen::MatrixXd& distance, const TourObjective& objective);

struct ViewTourParameters {
  double worth = 60.0;        ///< m of way that an unseen square metre is worth
  int fields_per_choice = 2;  ///< distance fields computed anew at most, each choice
};

/// Our own way to choose the next goal: the first stop of a tour that sees everything soon.
///
/// 1. Few view points that see all frontiers between them are kept (greedy set cover).
/// 2. The best open tour among those finds which are worth their way.
/// 3. Where something large is left, the tour of most gain exp(-0.2 way) through these is taken:
///    the criterion of [Gonzalez-Banos & Latombe 2002], for all stops in all orders.
/// 4. The tour that begins with the present goal is kept unless another is clearly better.
class ViewTour {
 public:
  explicit ViewTour(const ViewTourParameters& parameters = {}) : parameters_(parameters) {}

  /// @param view_points  with distances from the robot and gains.
  /// @param reach        m, how far the robot sees.
  /// @param present      target of the present goal, if it still stands.
  /// @param only_rests   nothing large is left: no gain is discounted.
  /// @return             index of the view point to go to; empty where none is worth its way.
  /// Cost: O(n^2 reach) lines of sight for n view points, and a few distance fields.
  std::optional<std::size_t> choose(const ExplorationGrid& grid, const FreeSpace& space,
                                    const std::vector<ViewPoint>& view_points, double reach,
                                    std::optional<Cell> present, bool only_rests);

  /// Finds ways from one of the stops that the last choice had too little time for: the next choice
  /// need not estimate them. For the steps between two choices. Cost: one distance field.
  void prepare(const ExplorationGrid& grid, const FreeSpace& space);

 private:
  struct Stop {
    std::size_t view_point;
    double promise;  ///< m^2, expected to be seen from it; of large frontiers, around them
    bool sees_present;
  };
  struct CachedField {
    Cell block;
    std::uint32_t made = 0;  ///< number of the choice that computed it
    std::uint32_t used = 0;
    DistanceField field;
  };

  std::vector<Stop> cover(const ExplorationGrid& grid, const std::vector<ViewPoint>& view_points,
                          double reach, std::optional<Cell> present, bool only_rests) const;
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
