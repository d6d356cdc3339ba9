// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/slam/slam.hpp"
#include "slam/contradiction_monitor.hpp"
#include "slam/correction_count.hpp"
#include "slam/graph_back_end.hpp"
#include "slam/jump_hypothesis.hpp"
#include "slam/key_frames.hpp"
#include "slam/map_part.hpp"
#include "slam/motion_prior.hpp"
#include "slam/odometry_chain.hpp"
#include "slam/tracking.hpp"

namespace cca {

/// All that Slam knows, and the steps from one scan to the next; its public functions are Slam's.
class Slam::State {
 public:
  State(const Pose2& T_map_start, ScanMatcher matcher)
      : T_map_start_(T_map_start), tracker_(matcher) {}
  void startAt(const Pose2& T_map_start) { T_map_start_ = T_map_start; }

  SlamPose step(const AnalysedScan& analysed, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot);

  std::optional<SweepHalves> sweepMotion(const AnalysedScan& analysed, const SweptScan& sweep,
                                         const Pose2& T_robot_sensor,
                                         const std::optional<Pose2>& T_odom_robot);

  void remember(const SlamMemory& memory);
  void startAnywhere() { starts_anywhere_ = map_.hasDriven(frames_.graph); }
  void finish(const DoAll& do_all = doInTurn);

  std::vector<Pose2> trajectory() const;
  std::vector<bool> isLocalised() const;
  std::vector<bool> isSetAside() const;
  bool isLost() const { return map_.isLost(frames_.graph); }
  bool isInMemory() const { return map_.isInMemory(frames_.graph); }
  int remembered() const { return map_.remembered(); }
  SlamMemory memory() const;

  const SlamWork& work() const { return back_end_.work(); }
  bool isSettled() const { return back_end_.isIdle(); }
  const KeyFrames& keyFrames() const { return frames_; }
  const std::vector<LoopVerdict>& loops() const { return back_end_.loopCloser().loops(); }
  const std::vector<LoopVerdict>& verdicts() const { return back_end_.loopCloser().verdicts(); }
  const LoopReview& review() const { return back_end_.review(); }
  int version() const { return corrections_.version(); }

 private:
  /// A scan, at its pose in a key frame.
  struct DrivenScan {
    int frame;
    Pose2 T_frame_sensor;
    Pose2 T_robot_sensor;
    bool is_doubtful;  ///< contradicted what was seen before, and was nowhere else either
  };
  /// A scan where it was predicted and matched.
  struct Tracked {
    std::optional<Pose2> odometry_step;
    MotionBelief motion;
    PoseBelief prior;
    LocalMatch found;
  };
  SlamPose beginPart(const Scan& scan, const Pose2& T_robot_sensor, ScanSurface surface);
  PoseBelief predict(const MotionBelief& motion) const;
  Tracked track(const ScanSurface& surface, const std::optional<Pose2>& odometry_step) const;
  Tracked trackNear(const ScanSurface& surface, const std::optional<Pose2>& step) const;
  void jump();
  bool takePose(const Tracked& tracked, std::size_t returns);
  int newFrame(const Scan& scan, const Pose2& T_robot_sensor, ScanSurface surface);
  void addKeyFrame(int frame, const GraphEdge& odometry, bool is_measured);
  void learnScale(const GraphEdge& odometry, const GraphEdge& match);
  void startPart(int frame);
  void advanceBackEnd();
  SlamPose poseNow(const Pose2& T_robot_sensor, double agreement,
                   const Eigen::Matrix3d& covariance) const;

  Pose2 T_map_start_;
  KeyFrames frames_;
  std::vector<KeyScan> key_scans_;  ///< of each frame
  ScanTracker tracker_;
  MotionPrior motion_;
  OdometryChain odometry_;
  ContradictionMonitor monitor_;
  JumpHypothesis jump_;
  MapPart map_;
  bool starts_anywhere_ = false;  ///< with the next scan
  GraphBackEnd back_end_;
  CorrectionCount corrections_;
  std::vector<DrivenScan> scans_;  ///< all so far, those of earlier drives first
  Pose2 T_map_sensor_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  ///< of it, map axes
};

}  // namespace cca
