// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"
#include "sensing/sweep_identification.hpp"
#include "sensing/undistortion.hpp"

namespace cca {

/// Brings each scan of one laser to one instant, by the laser's motion while it was taken.
///
/// How long a sweep is comes from the scan (sweep_duration, of the driver's time_increment) where
/// it is plausible: at most the time between two scans, and not below a fiftieth of that. Else it
/// is the share of the time between scans that the field of view has of a full turn. A driver that
/// tells a plausible duration is believed until SweepIdentification knows better; where none does,
/// the scans are of one instant until it knows better.
///
/// The motion is that of the odometry, of constant acceleration through readings before, in and
/// after the middle of the sweep. Where nobody tells those around, it goes on as at the last scans.
/// Without odometry, or where readings are more than half a second apart or further than a robot
/// can have driven, nothing is undone.
class MotionCompensation {
 public:
  MotionCompensation() = default;
  /// @param told  s, the sweep's duration with its sign, see Scan::sweep_duration: nothing is
  ///              learned then. 0: of one instant.
  explicit MotionCompensation(double told) : told_(told) {}

  /// @param scan  as the driver gives it; the scans of one laser, in the order of time.
  /// @return      the scan of one instant; `scan` itself where there is nothing to undo.
  /// Cost: O(beams); see SweepIdentification while that learns.
  Scan undistort(const Scan& scan, const SweepMotion& motion);
  /// How the last scan was undistorted; nothing where there was nothing to undo.
  const std::optional<SweptScan>& undone() const { return undone_; }
  /// The last scan by another motion. @pre  undone().
  Scan undistortBy(const SweepHalves& motion) const;
  /// The middle of the last sweep as it has become known since.
  void amend(const Pose2& T_odom_sensor);

  /// Whether more scans may tell more of the sweep.
  bool isLearning() const { return !told_ && !identification_.isSettled(); }
  /// How often more scans have told another sweep than what the scans before were undistorted by.
  int version() const { return version_; }
  /// How often another laser, or another rate of turning, has begun to be learned.
  int lasers() const { return lasers_; }
  /// Goes through the scans so far once more, by what is known now; learns nothing from them until
  /// learnOn().
  void repeat();
  void learnOn() { is_repeating_ = false; }

  /// s, with its sign: what the last scan was undistorted by.
  double sweepDuration() const { return duration_; }

 private:
  struct Taken {
    Scan scan;
    SensorReading middle;
    double candidate;
  };
  std::optional<double> period() const;
  double candidate(const Scan& scan) const;
  double signedDuration(const Scan& scan, double candidate) const;
  void identify(const Taken& next);

  std::optional<double> told_;
  double duration_ = 0.0;
  std::deque<Taken> taken_;  ///< the last three
  Scan swept_;               ///< the last one
  std::optional<SweptScan> undone_;
  std::deque<double> periods_;  ///< s, the last ones between scans
  SweepIdentification identification_;
  double identified_for_ = 0.0;  ///< s, the duration that it has been asked about
  int version_ = 0, lasers_ = 0;
  bool is_repeating_ = false;
};

}  // namespace cca
