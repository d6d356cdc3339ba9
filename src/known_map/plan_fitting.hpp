// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "known_map/global_localisation.hpp"
#include "known_map/open_doors.hpp"
#include "known_map/plan_matching.hpp"
#include "known_map/plan_sight.hpp"

namespace cca {

/// A scan that is to be fitted.
struct TakenScan {
  const ScanSurface& surface;
  std::vector<SightRay> rays;  ///< see sightRays()
  Eigen::Matrix3d covariance;  ///< how far it errs as a whole, see PlanMatching
};

/// A scan where it fits a plan, and what the plan says of it there.
struct PlanFit {
  PlanMatch match;
  SightShares seen;
  std::vector<PieceSight> said;
  double evidence = 0.0;  ///< nats a beam
};

/// m, rad: one standard deviation along the longest axis of a position, and of a heading.
struct PoseSpread {
  double position, turn;
};
/// @param covariance  of (x, y, theta), positive semidefinite.
PoseSpread spreadOf(const Eigen::Matrix3d& covariance);

/// Fits scans to a plan, judges how well each fits, and learns from those that are localised: what
/// is usual, how far the plan is off, and which of its doors stand open.
class PlanFitting {
 public:
  /// m, of a match that begins where the sensor is: coarser than its finest reach by a round.
  static constexpr double kLeastMatchReach = 0.15;

  PlanFitting(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas);

  /// Downhill from `start`. @param reach, share  see PlanMatching.
  PlanFit fitAt(const TakenScan& scan, const Pose2& start, const PoseBelief& prior, double reach,
                double share) const;
  /// About where the wheels have the sensor: downhill from there, and from no farther off than a
  /// match is fine where that leads beyond belief; where wheels may err by more than a match
  /// reaches, or where that does not fit, from what fits best around.
  PlanFit fitAbout(const TakenScan& scan, const PoseBelief& prior, double share) const;
  /// Within three sigmas of where somebody says that the sensor is.
  PlanFit fitWithin(const TakenScan& scan, const PoseBelief& told) const;

  /// Whether the robot may be elsewhere. Where most of a scan is on the plan's lines and next to
  /// nothing goes through any, what else it sees is furniture, however little of that is usual.
  bool isDoubtful(const PlanFit& fit) const;
  /// In doubt, and not even the best that is known of where the robot is.
  bool isRefuted(const PlanFit& fit) const;

  /// @param share  in [0, 1], of a scan that is localised, that is news.
  void learn(const PlanFit& fit, double share);

  const PlanLines& plan() const { return plan_; }
  GlobalLocalisation& global() { return global_; }
  const GlobalLocalisation& global() const { return global_; }
  const SightModel& sights() const { return sights_; }
  double planSigma() const { return plan_sigma_; }  ///< m

 private:
  double doubt() const;

  PlanLines plan_;
  GlobalLocalisation global_;
  SightModel sights_;
  OpenDoors doors_;
  double plan_sigma_;
};

}  // namespace cca
