// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// The scans that matter of a way so far, one every few steps, so that maps can be made anew where
/// their poses are corrected.
class PastScans {
 public:
  struct Kept {
    std::size_t step;         ///< its number among all scans
    Scan scan;                ///< at T_map_sensor as believed now
    Pose2 T_map_robot;        ///< as believed now
    Pose2 T_was_robot{};      ///< as believed before the last correction
    bool was_placed = false;  ///< whether that was known
    std::size_t sensor = 0;   ///< which laser
  };

  /// Takes the next scan, and keeps it where the robot has moved 20 cm or 10 degrees since the last
  /// one that was kept.
  /// @param is_placed  whether the pose is known: otherwise it is kept until a correction tells it.
  void add(const Scan& scan, const Pose2& T_map_robot, bool is_placed = true);

  /// Takes a scan of another laser (1, 2, ...) from about the time of the scan with the number
  /// `step`, with which it goes where that is corrected; kept by the same rule.
  /// @param step  not below that of any scan taken before. @param T_map_robot  at that step.
  void addBeside(std::size_t step, const Scan& scan, const Pose2& T_map_robot, std::size_t sensor);

  /// @param T_map_robot  of all scans taken so far, in their order, as believed now.
  /// @param is_placed    of each of them, whether that is known.
  void correct(const std::vector<Pose2>& T_map_robot, const std::vector<bool>& is_placed);

  /// Those whose place is known, in their order.
  const std::vector<Kept>& kept() const { return kept_; }
  std::size_t size() const { return steps_; }  ///< scans taken

  /// By how much the last correction moved a place: T_map_was of the scan taken nearest to it whose
  /// place was known, of equally near ones the latest. @param p_was  m, map frame before the
  /// correction. Cost: O(scans kept).
  Pose2 correctionAt(const Eigen::Vector2d& p_was) const;
  /// The same for the robot.
  Pose2 correctionHere() const;

 private:
  std::size_t steps_ = 0;
  std::vector<Kept> kept_, unplaced_;
};

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
