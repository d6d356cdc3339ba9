// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"

namespace cca {

/// Somebody else tells where the robot is, and now and then finds out that it was elsewhere: then
/// map -> odom leaps, and all that was mapped before lies in the wrong place. Keeps scans with
/// their odometry, and places the past anew.
///
/// Where the other one tells its corrected poses, these are taken. Where a leap is all there is,
/// it is spread over the way since the last one, or over all of the way, or moves all of it, or
/// moves nothing, where the wheels slipped: whatever the scans contradict least.
class OuterCorrections {
 public:
  explicit OuterCorrections(const CcaParameters& mapping) : mapping_(mapping) {}

  struct TimedPose {
    double time;  ///< s
    Pose2 T_map_robot;
  };

  /// Takes the next scan. @param time  s, never falling.
  /// @return  whether the past(), which ends before this scan, was placed anew.
  /// Cost: O(1); where map -> odom leapt, that of five maps of the scans kept, the first four of
  /// which take 150 scans at most.
  bool add(const Scan& scan, const Pose2& T_map_robot, const Pose2& T_odom_robot, double time);

  /// Takes a scan of another laser (1, 2, ...) after that.
  void addBeside(const Scan& scan, std::size_t sensor);

  /// Takes poses of the robot as corrected by who tells them, in the order of time; those of no
  /// scan's time are passed over. They are heeded with the next scan. Between them, and from the
  /// last one to where the robot is now, map -> odom is taken for changing evenly.
  void correct(std::vector<TimedPose> path);

  /// Whether somebody has told corrected poses: then leaps need no guess.
  bool isTold() const { return is_told_; }

  const PastScans& past() const { return past_; }
  /// Where the robot was at each scan so far, as believed now.
  std::vector<TimedPose> way() const;

 private:
  struct Step {
    double time;  ///< s
    double way;   ///< m so far, turning included
    Pose2 T_odom_robot, T_map_odom;
  };
  using Odometries = std::vector<Pose2>;  ///< T_map_odom of each step

  bool hasLeapt(const Step& now) const;
  Odometries spread(const Step& now, std::size_t since, bool moves_all) const;
  std::optional<Odometries> afterLeap(const Step& now, const Scan& scan) const;
  std::optional<Odometries> afterPath(const Step& now) const;
  int agreement(const Odometries& T_map_odom, const Scan& scan) const;
  void place(const Odometries& T_map_odom);

  CcaParameters mapping_;
  std::vector<Step> steps_;
  std::size_t last_leap_ = 0;  ///< the step after it
  std::vector<TimedPose> path_;
  bool is_told_ = false;
  bool is_path_new_ = false;
  PastScans past_;
  std::optional<Scan> last_;  ///< not yet among the past
};

}  // namespace cca
