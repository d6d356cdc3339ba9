// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/mapping/parameters.hpp"

namespace cca {

/// Somebody else tells where the robot is, and now and then finds out that it was elsewhere: then
/// map -> odom leaps, and all that was mapped before lies in the wrong place. Remembers the
/// odometry of each scan, and places the past anew.
///
/// Where the other one tells its corrected poses, these are taken. Where a leap is all there is,
/// it is spread over the way since the last one, or over all of the way, or moves all of it, or
/// moves nothing, where the wheels slipped: whatever the scans contradict least.
class ExternalCorrections : public Localiser {
 public:
  explicit ExternalCorrections(const CcaParameters& mapping) : mapping_(mapping) {}

  struct TimedPose {
    double time;  ///< s
    Pose2 T_map_robot;
  };

  /// Takes the next scan at its T_map_robot. Without odometry map -> odom has stayed as it was.
  /// Cost: O(1); where map -> odom leapt, that of five maps of the scans kept, the first four of
  /// which take 150 scans at most.
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;
  bool correctsPast() const override { return true; }
  std::vector<Pose2> trajectory() const override;
  std::vector<bool> isLocalised() const override;

  /// Takes poses of the robot as corrected by who tells them, in the order of time; those of no
  /// scan's time are passed over. They are applied with the next scan. Between them, and from the
  /// last one to where the robot is now, map -> odom is taken for changing evenly.
  void correct(std::vector<TimedPose> path);

  /// Whether somebody has told corrected poses: then leaps need no guess.
  bool isTold() const { return is_told_; }

 private:
  struct Step {
    double time;  ///< s
    double way;   ///< m so far, turning included
    Pose2 T_odom_robot, T_map_odom;
  };
  using Odometries = std::vector<Pose2>;  ///< T_map_odom of each step

  bool hasLeapt(const Step& now) const;
  Odometries spread(const Step& now, std::size_t since, bool moves_all) const;
  std::optional<Odometries> afterLeap(const Step& now, const Scan& scan,
                                      const PastScans& past) const;
  std::optional<Odometries> afterPath(const Step& now) const;
  int agreement(const Odometries& T_map_odom, const Scan& scan, const PastScans& past) const;

  CcaParameters mapping_;
  std::vector<Step> steps_;
  std::size_t last_leap_ = 0;  ///< the step after it
  std::vector<TimedPose> path_;
  bool is_told_ = false;
  bool is_path_new_ = false;
  std::vector<bool> is_localised_;  ///< of each step
};

}  // namespace cca
