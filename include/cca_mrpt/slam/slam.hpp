// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/slam/correlative_search.hpp"
#include "cca_mrpt/slam/key_frames.hpp"
#include "cca_mrpt/slam/loop_closing.hpp"
#include "cca_mrpt/slam/motion_prior.hpp"

namespace cca {

/// Where the robot is, as Slam::step() believes.
struct SlamPose {
  Pose2 T_map_robot;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< (x, y) map axes, theta: of the last match
  double agreement = 0.0;       ///< of the scan with what was seen before, [0, 1]
  int version = 0;              ///< counts corrections of the past by more than 5 cm
};

/// Line SLAM: poses from wheels and laser, with loops.
class Slam {
 public:
  explicit Slam(const Pose2& T_map_start = {}) : T_map_start_(T_map_start) {}

  /// @param scan            T_map_sensor is not used.
  /// @param T_odom_robot    in any frame that stays; nothing: the robot goes on as it went.
  SlamPose step(const Scan& scan, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot);

  /// The last pass over a whole log: all poses made to agree with all lines.
  void finish();

  /// T_map_robot of each scan so far, in order, as the graph has them now.
  std::vector<Pose2> trajectory() const;

  const KeyFrames& keyFrames() const { return frames_; }
  const std::vector<LoopVerdict>& loops() const { return loops_; }
  const std::vector<LoopVerdict>& verdicts() const { return verdicts_; }
  int version() const { return version_; }

 private:
  struct Passed {  // a scan, hung on a key frame
    int frame;
    Pose2 T_frame_sensor;
    Pose2 T_robot_sensor;
  };
  bool isNewPlace(const Pose2& T_map_sensor, const ScanSurface& surface) const;
  void addKeyFrame(ScanSurface surface, const Pose2& T_map_sensor, const Pose2& wheels,
                   const Eigen::Matrix3d& wheels_information);
  void closeLoops(int frame);
  bool agree(const LoopVerdict& a, const LoopVerdict& b) const;
  void accept(const LoopVerdict& verdict);
  void countVersion();
  struct Located {
    MatchResult match;
    double agreement = 0.0;  ///< with the frames in view
  };
  static SearchWindow windowOf(const PoseBelief& prior);
  Pose2 searched(const ScanSurface& surface, SearchWindow window) const;
  Located located(const ScanSurface& surface, const PoseBelief& prior,
                  const SearchWindow& window) const;

  Pose2 T_map_start_;
  KeyFrames frames_;
  MotionPrior motion_;
  std::vector<GraphEdge> wheel_edges_;
  std::vector<Passed> passed_;
  std::vector<int> view_;  ///< frames that the next scans are matched to
  std::optional<Pose2> last_odom_sensor_;
  Pose2 T_map_sensor_;
  // Since the last key frame: what the wheels alone say, and how well.
  Pose2 T_frame_wheels_;
  Eigen::Matrix3d wheels_covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  std::vector<LoopVerdict> verdicts_, waiting_, loops_;
  int version_ = 0;
  std::vector<Pose2> at_version_;  ///< poses of the frames as whoever holds a map knows them
  int last_optimised_ = 0;
  bool unsettled_ = false;  ///< the graph has loops that its poses have not been solved for
};

}  // namespace cca
