// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cca_mrpt/known_map/plan.hpp"
#include "cca_mrpt/localisation/localiser.hpp"

namespace cca {

class GlobalLocalisation;
class PlanLines;
class SightModel;
struct SightShares;

/// Where the robot is in a finished map, or in the plan of an architect, which stays as it is.
///
/// While the robot is localised a scan costs one prediction by the wheels, one match to the lines
/// of the plan, and one look at what its beams say of them. What the plan does not show, furniture
/// and people, bears on nothing: such returns have no line, and how many there are is learned. A
/// robot whose beams go through lines has been carried, or has slipped: it is lost, says so, and is
/// looked for in the whole plan (GlobalLocalisation), as one is that starts anywhere.
///
/// Of a laser that sweeps, a scan is undone anew first, by what the last ones that were localised
/// saw around (matchSweep()).
///
/// Deterministic. The memory is that of the plan; nothing grows with the drive.
class KnownMap : public Localiser {
 public:
  /// @param sigmas  of the lines, see PlanLines; their common error is in the covariance told.
  explicit KnownMap(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas = {},
                    const LocalisationEffort& effort = {});
  ~KnownMap() override;

  /// Somebody tells where the robot is, about: it is looked for within three sigmas with the next
  /// scan, and then followed.
  /// @param covariance  (x, y) m^2, map axes, heading rad^2; diagonal elements count.
  void place(const Pose2& T_map_robot, const Eigen::Matrix3d& covariance);

  /// @return  is_known: whether the robot is localised; where it is not, the pose is a guess, and
  ///          the covariance zero.
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;
  /// The same for a scan brought to one instant that nobody has analysed yet.
  Estimate localise(const Measurement& measurement);

  int timesLost() const;
  /// Of the last scan.
  const SightShares& seen() const;
  /// m, rms distance from the plan of the returns of the last scan that lie on it.
  double residual() const;
  const SightModel& sights() const;
  double planSigma() const;  ///< m, as learned
  const PlanLines& plan() const;
  const GlobalLocalisation& global() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace cca
