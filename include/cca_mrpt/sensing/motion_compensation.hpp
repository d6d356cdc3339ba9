// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/sensing/sweep_identification.hpp"
#include "cca_mrpt/sensing/undistortion.hpp"

namespace cca {

/// What the wheels say at a time.
struct OdometryReading {
  Pose2 T_odom_robot;
  double time;  ///< s
};

/// What they say before and after the middle of a sweep, best at its ends.
struct OdometryAround {
  std::optional<OdometryReading> before, after;
};

/// Brings each scan of one laser to one instant, by the motion of the robot while it was taken.
///
/// How long a sweep is comes from the scan (sweep_duration, of the driver's time_increment) where
/// it is plausible: at most the time between two scans, and not below a fiftieth of that. Else it
/// is the share of the time between scans that the field of view has of a full turn. A driver that
/// tells a plausible duration is believed until SweepIdentification knows better; where none does,
/// the scans are of one instant until it knows better.
///
/// The motion is that of the odometry, of constant acceleration through readings before, in and
/// after the middle of the sweep. Where nobody tells those around, it goes on as at the last scans.
/// Without odometry, or where readings are more than half a second apart, nothing is undone.
class MotionCompensation {
 public:
  MotionCompensation() = default;
  /// @param told  s, the sweep's duration with its sign, see Scan::sweep_duration: nothing is
  ///              learned then. 0: of one instant.
  explicit MotionCompensation(double told) : told_(told) {}

  /// @param scan    as the driver gives it; the scans of one laser, in the order of time.
  /// @param now     in the middle of the sweep, or at the stamp where that is not known; nothing
  ///                where there is no odometry or no time.
  /// @param around  as far as it is known.
  /// @return        the scan of one instant; `scan` itself where there is nothing to undo.
  /// Cost: O(beams); see SweepIdentification while that learns.
  Scan undistort(const Scan& scan, const Pose2& T_robot_sensor,
                 const std::optional<OdometryReading>& now, const OdometryAround& around = {});

  /// Whether more scans may tell more of the sweep.
  bool isLearning() const;
  /// Goes on with other scans, or the same from the first on: what has been learned stays.
  void beginAnew() { taken_.clear(); }

  /// s, with its sign: what the last scan was undistorted by.
  double sweepDuration() const { return duration_; }

 private:
  struct Taken {
    Scan scan;
    Pose2 T_robot_sensor;
    OdometryReading odometry;
    double candidate;
  };
  std::optional<double> period() const;
  double candidate(const Scan& scan) const;
  double signedDuration(const Scan& scan, double candidate) const;
  void identify(const Taken& next);

  std::optional<double> told_;
  double duration_ = 0.0;
  std::deque<Taken> taken_;     ///< the last three
  std::deque<double> periods_;  ///< s, the last ones between scans
  SweepIdentification identification_;
  double identified_for_ = 0.0;  ///< s, the duration that it has been asked about
};

}  // namespace cca
