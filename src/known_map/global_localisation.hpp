// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <unordered_set>
#include <vector>

#include "cca_mrpt/known_map/plan.hpp"
#include "known_map/plan_matching.hpp"
#include "known_map/plan_sight.hpp"
#include "slam/correlative_search.hpp"

namespace cca {

/// A place where the robot may be.
struct Hypothesis {
  Pose2 T_map_sensor;            ///< at the last view
  Eigen::Matrix3d information;   ///< of the last match
  double prior = 0.0;            ///< nats: how likely it was before anything was seen of it
  std::vector<double> evidence;  ///< nats, of each view
  SightShares seen;              ///< of all views
  double total() const;
};

/// Where the robot would be if nobody had carried it: in the frame in which the wheels count.
struct Expectation {
  Pose2 T_map_wheels;
  double reach = 0.0, turn = 0.0;  ///< m, rad, that the wheels may have erred by meanwhile

  /// m, rad: of what errs by more, the place is sought anywhere. Nor is a place that somebody tells
  /// sought farther around.
  static constexpr double kWidestReach = 3.0, kWidestTurn = 0.8;
};

/// Where a robot is that may be anywhere in a plan: multi-hypothesis localisation [Jensfelt &
/// Kristensen 2001] without particles.
///
/// Each half metre the robot keeps a view. The places of the whole plan that a view fits best are
/// found by branch and bound [Hess et al. 2016], matched to the plan's lines, and judged by what
/// beams say: of those that end where the plan has a line, and of those that have gone through one.
/// What was seen before counts once, however often it is seen. All hypotheses go along with the
/// wheels, and each further view is asked of all of them. One is believed when it is more likely
/// than every other one, and than chance, by kClear. Until then the robot is not localised: rooms
/// that are alike stay so until the robot has seen what tells them apart.
///
/// A robot that was localised and is no longer has more likely left what the plan shows than been
/// carried away, and rooms of a building are alike: a place that the wheels do not lead to has to
/// explain a room more than any other place, and than the wheels' place, where a view that shows
/// nothing of the plan says nothing.
class GlobalLocalisation {
 public:
  /// @param plan  outlives this. Builds a likelihood pyramid of it: the memory grows with its area.
  explicit GlobalLocalisation(const PlanLines& plan);

  /// Forgets all views. @param window  where the robot is; nothing: anywhere in the plan.
  void begin(const std::optional<SearchWindow>& window = {});
  /// Where the wheels have it by the next scan. @param expectation  nothing: nobody knows.
  void expect(const std::optional<Expectation>& expectation) { expectation_ = expectation; }

  /// Takes the next scan. @param T_wheels_sensor  in any frame that stays.
  /// @return  where the sensor is, map frame, once that is beyond doubt: as its last view was
  ///          matched, and by the wheels since.
  /// Cost: that of the effort, whatever the size of the plan.
  std::optional<PoseBelief> add(const ScanSurface& surface, const Pose2& T_wheels_sensor,
                                const SightModel& model, const LocalisationEffort& effort);

  /// Where in a window a scan fits the plan best; nothing where it does not. Takes no part in what
  /// add() does. Cost: that of a search of the window.
  std::optional<Pose2> bestIn(const SearchWindow& window, const ScanSurface& surface) const;

  /// The most likely one first.
  const std::vector<Hypothesis>& hypotheses() const { return hypotheses_; }
  std::size_t views() const { return views_.size(); }
  /// Whether what was seen so far has been asked of the whole plan.
  bool isSettled() const { return !search_ && candidates_.empty() && searched_; }

  static constexpr double kClear = 6.0;  ///< nats: one in four hundred

 private:
  struct View {
    ScanSurface surface;
    std::vector<SightRay> rays;  ///< to what no view before has seen
    Pose2 T_wheels_sensor;
  };
  bool isNewView(const Pose2& T_wheels_sensor) const;
  void work(const SightModel& model, const LocalisationEffort& effort);
  void addView(const ScanSurface& surface, const Pose2& T_wheels_sensor);
  void dropView();
  void beginSearch();
  void judge(const View& view, const Pose2& start, const PoseBelief& prior, double reach,
             const SightModel& model, Hypothesis& hypothesis);
  void judgeAfter(std::size_t from, std::size_t to, const SightModel& model,
                  Hypothesis& hypothesis);
  bool isBehind(const Hypothesis& hypothesis, std::size_t first) const;
  std::optional<Hypothesis> judgedByAll(std::size_t at, const Pose2& T_map_sensor,
                                        const SightModel& model);
  void askNeighbours(const SightModel& model);
  double priorOf(const Hypothesis& hypothesis, const SightModel& model) const;
  void askExpected(const SightModel& model);
  bool standsAlone() const;
  void sortOut();
  std::optional<PoseBelief> decided(const Pose2& T_wheels_sensor, const SightModel& model);

  const PlanLines& plan_;
  LikelihoodPyramid pyramid_;
  std::optional<SearchWindow> window_;
  std::optional<Expectation> expectation_;
  double expected_evidence_ =
      0.0;                     ///< nats: of all views, where the wheels lead; see standsAlone()
  SightShares expected_seen_;  ///< there, by all views
  std::deque<View> views_;
  std::unordered_set<std::int64_t> seen_;  ///< cells of the wheels' frame
  std::optional<PoseSearch> search_;
  std::size_t searching_ = 0;      ///< the view that is, or was, searched for
  bool searched_ = false;          ///< at least one search has come to its end
  std::vector<Pose2> candidates_;  ///< of the last search, still to be judged, the best last
  std::vector<Hypothesis> hypotheses_;
  int matches_ = 0;  ///< done with this scan
};

}  // namespace cca
