// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/known_map/global_localisation.hpp"
#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/slam/motion_prior.hpp"

namespace cca {

/// Where the robot is in a finished map, or in the plan of an architect, which stays as it is.
///
/// While the robot is localised a scan costs one prediction by the wheels, one match to the lines
/// of the plan, and one look at what its beams say of them. What the plan does not show, furniture
/// and people, bears on nothing: such returns have no line, and how many there are is learned. A
/// robot whose beams go through lines has been carried, or has slipped: it is lost, says so, and is
/// looked for in the whole plan (GlobalLocalisation), as one is that starts anywhere.
///
/// Deterministic. The memory is that of the plan; nothing grows with the drive.
class KnownMap : public Localiser {
 public:
  /// @param sigmas  of the lines, see PlanLines; their common error is in the covariance told.
  explicit KnownMap(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas = {},
                    const LocalisationEffort& effort = {});

  /// Somebody tells where the robot is, about: it is looked for within three sigmas with the next
  /// scan, and then followed.
  /// @param covariance  (x, y) m^2, map axes, heading rad^2; diagonal elements count.
  void place(const Pose2& T_map_robot, const Eigen::Matrix3d& covariance);

  /// @return  is_known: whether the robot is localised; where it is not, the pose is a guess, and
  ///          the covariance zero.
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;
  /// The same for a scan of one instant that nobody has analysed yet.
  Estimate localise(const Measurement& measurement) {
    return update(measurement, analyse(measurement.scan), {});
  }

  int timesLost() const { return times_lost_; }
  /// Of the last scan.
  const SightShares& seen() const { return seen_; }
  /// m, rms distance from the plan of the returns of the last scan that lie on it.
  double residual() const { return residual_; }
  const SightModel& sights() const { return sights_; }
  double planSigma() const { return plan_sigma_; }  ///< m, as learned
  const PlanLines& plan() const { return plan_; }
  const GlobalLocalisation& global() const { return global_; }

 private:
  struct Told {
    Pose2 T_map_robot;
    Eigen::Matrix3d covariance;
  };
  struct Fit {
    PlanMatch match;
    SightShares seen;
    double evidence = 0.0;  ///< nats a beam
  };
  /// What the beams said of a piece of the plan.
  struct PieceRecord {
    double explained = 0.0, through = 0.0;
  };
  Fit fitAt(const ScanSurface& surface, const Pose2& start, const PoseBelief& prior, double reach,
            double share) const;
  double doubt() const;
  void track(const ScanSurface& surface, const std::optional<Pose2>& wheel_step,
             const MotionBelief& motion);
  Fit fitAbout(const ScanSurface& surface, const PoseBelief& prior, double share) const;
  void search(const ScanSurface& surface, const MotionBelief& motion);
  /// The robot is where it was found, and is followed from there on.
  void follow(const Fit& found);
  void takePlace(const ScanSurface& surface, const Pose2& T_robot_sensor);
  void learn(const ScanSurface& surface, const Fit& fit, double share);
  void countDoubt(bool is_doubtful, const Pose2& step);
  void lose();
  void expectAlongWheels();
  Estimate estimate(const Pose2& T_robot_sensor) const;

  PlanLines plan_;
  LocalisationEffort effort_;
  GlobalLocalisation global_;
  MotionPrior motion_;
  SightModel sights_;
  double plan_sigma_;
  std::vector<PieceRecord> records_;
  std::vector<bool> is_open_;  ///< pieces that rays pass: doors
  std::optional<Told> told_;
  std::optional<Pose2> last_odom_sensor_;
  Pose2 T_map_sensor_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d scan_covariance_ = Eigen::Matrix3d::Identity();  ///< see PlanMatching
  LineSigma map_sigma_;                                            ///< see PlanMatch
  Pose2 T_wheels_sensor_;                        ///< since the beginning, whoever carried the robot
  double wheels_way_ = 0.0, wheels_turn_ = 0.0;  ///< m, rad, of these in all
  /// The last place that the robot has been followed to for a while, and when that was.
  struct Trusted {
    Pose2 T_map_wheels;
    double wheels_way, wheels_turn;
  };
  std::optional<Trusted> trusted_;
  double followed_way_ = 0.0;  ///< m, since it was placed or found
  bool is_localised_ = false, is_fresh_ = true;
  int times_lost_ = 0;
  int doubtful_scans_ = 0;
  double doubtful_way_ = 0.0;
  SightShares seen_;
  double residual_ = 0.0;
};

}  // namespace cca
