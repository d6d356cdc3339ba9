// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"
#include "slam/likelihood_pyramid.hpp"

namespace cca {

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
};

struct SearchResult {
  Pose2 T_map_query;
  double score = 0.0;  ///< mean likelihood of the query's points, in [0, 1], without the prior
};

/// The pose with the best mean likelihood of the query's points in a window, less the prior's
/// penalty: exact to the grid, by branch and bound [Hess et al. 2016; Olson 2009]; bit by bit.
class PoseSearch {
 public:
  /// @param query        sensor frame.
  /// @param least_score  what scores less is not found.
  PoseSearch(std::vector<SurfacePoint> query, LikelihoodPyramid pyramid, const SearchWindow& window,
             double least_score);

  /// Goes on. @param cells  of the pyramid that are looked up, about so many: the same ones
  ///                        whatever the bits.
  /// @return  whether the search is at its end.
  bool advance(int cells);
  /// Goes on to the end.
  void run();
  /// At the end; nothing where no pose scores more than the least.
  const std::optional<SearchResult>& found() const { return found_; }

  /// Begins again, for any pose that scores more than this, and is not within so much [m, and rad]
  /// of what was found: ends with the first.
  void seekRival(double distance, double turn, double least_score);

  /// Lets the search find the best places, each at least so far [m, or rad] from the others, not
  /// the best one alone. To be called before advance().
  void keepSeveral(std::size_t count, double distance, double turn);
  /// At the end; the best one first.
  const std::vector<SearchResult>& several() const { return several_; }

 private:
  struct Candidate {
    double bound;
    int level;
    int turn, x, y;  // steps from the window's corner
  };
  /// One turn of the query: its points in cells, at the window's lowest shift.
  struct TurnedQuery {
    double angle, penalty;
    std::vector<Eigen::Vector3i> cells;                // (x, y, layer)
    std::vector<int> offsets;                          // the same, see LikelihoodPyramid::offset()
    int low_x = 0, low_y = 0, high_x = 0, high_y = 0;  // of these cells
  };
  /// What was found before, whose neighbourhood is passed over.
  struct Excluded {
    Pose2 T_map_query;
    double distance, turn;
  };
  struct Several {
    std::size_t count;
    double distance, turn;
  };
  int turns() const { return 2 * half_turns_ + 1; }
  void begin(double least_score);
  TurnedQuery turnedQuery(int turn) const;
  void openTurn(int turn);
  void expand(const Candidate& candidate);
  void openIfGood(Candidate candidate);
  void sortFrom(std::size_t first);
  Pose2 poseOf(const Candidate& candidate) const;
  double scoreOf(const Candidate& candidate, double least);
  int missedBy(const Candidate& candidate, int most);
  double penaltyOf(const Candidate& candidate) const;
  bool isExcluded(const Candidate& candidate) const;
  void keep(const Candidate& candidate);

  std::vector<SurfacePoint> query_;
  std::vector<double> facings_;  // rad, of the query's points
  LikelihoodPyramid pyramid_;
  SearchWindow window_;
  int steps_ = 0, half_turns_ = 0;
  std::vector<TurnedQuery> turned_;
  int next_turn_ = 0;                 // to be opened
  std::vector<Candidate> open_;       // the most promising part last
  std::optional<Excluded> excluded_;  // where a rival is sought
  std::optional<Several> wanted_;     // where several are to be found
  std::vector<SearchResult> several_;
  double best_bound_ = 0.0;
  std::optional<SearchResult> found_;
  int looked_up_ = 0;  // cells, since advance() began
};

/// PoseSearch in one go.
std::optional<SearchResult> searchPose(std::vector<SurfacePoint> query, LikelihoodPyramid pyramid,
                                       const SearchWindow& window, double least_score);

}  // namespace cca
