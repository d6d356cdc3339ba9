// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cca_mrpt/sensing/analysed_scan.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"

namespace cca {

/// Does task(0) to task(count - 1), each once, in any order and at the same time as it likes;
/// returns when all are done. Who has threads says how.
using DoAll = std::function<void(int count, const std::function<void(int)>& task)>;
/// One after another.
void doInTurn(int count, const std::function<void(int)>& task);

/// One scan of the laser that the robot is localised by, and what is known of where it was taken.
struct Measurement {
  /// Its T_map_sensor is where T_map_robot puts the laser, and has no meaning without that pose. As
  /// the driver gives it where a MappingSession takes it, which brings it to one instant.
  Scan scan;
  Pose2 T_robot_sensor;
  std::optional<Pose2> T_odom_robot{};  ///< from the wheels, in any frame that stays
  std::optional<Pose2> T_map_robot{};   ///< where somebody else knows it
  double time = 0.0;                    ///< s, of the poses, never falling; 0 where nobody tells
  SweepMotion motion{};                 ///< during the sweep, as far as it is known
  /// How the scan was brought to one instant; nothing where there was nothing to undo, or as the
  /// driver gives it.
  std::optional<SweptScan> undone{};
};

/// Where a localiser believes that a scan was taken.
struct Estimate {
  Pose2 T_map_robot;
  Pose2 T_map_sensor;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< (x, y) map axes, theta; zero where the localiser has none
  double agreement = 1.0;       ///< of the scan with what was seen before, [0, 1]
  bool is_known = true;         ///< false: the robot is lost; the pose is a guess
  bool was_corrected = false;   ///< the poses of the past have changed with this scan
};

/// Tells where the robot is, scan by scan. One interface for given poses, odometry, SLAM and the
/// localisation in a known map. Deterministic.
class Localiser {
 public:
  virtual ~Localiser() = default;

  /// @param measurement  the next scan, as the driver gave it.
  /// @param analysed     the same, brought to one instant.
  /// @param past         the scans kept so far, without this one, at the poses believed now.
  virtual Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                          const PastScans& past) = 0;

  /// The sensor's motion within the sweep of the next scan, as the scan itself shows it, bent by
  /// what was undone wrongly; nothing where it shows nothing. To be asked before update(), to which
  /// the scan goes undone by that.
  virtual std::optional<SweepHalves> sweepMotion(const Measurement& /*measurement*/,
                                                 const AnalysedScan& /*analysed*/,
                                                 const SweptScan& /*sweep*/) {
    return std::nullopt;
  }

  /// Whether it takes each measurement's T_map_robot for the robot's pose, whatever the scan shows.
  virtual bool believesGivenPoses() const { return false; }

  /// Whether the poses of the past may be corrected: then trajectory() and isLocalised() tell how.
  virtual bool correctsPast() const { return false; }
  /// A last pass over the whole drive, for those who correct the past.
  /// @param do_all  shares out what can be done at once.
  virtual void finish(const DoAll& /*do_all*/) {}
  /// T_map_robot of each scan so far as believed now, those of earlier drives first.
  virtual std::vector<Pose2> trajectory() const { return {}; }
  /// Of each of these, whether its pose in the map is known.
  virtual std::vector<bool> isLocalised() const { return {}; }
  /// How many scans are of earlier drives: the first ones.
  virtual std::size_t remembered() const { return 0; }

  /// What it believes now, to go back to; null where it cannot go back. Cost: a copy.
  virtual std::unique_ptr<Localiser> snapshot() const { return nullptr; }
  /// Goes back. @param snapshot  one of its own.
  virtual void restore(const Localiser& /*snapshot*/) {}
};

}  // namespace cca
