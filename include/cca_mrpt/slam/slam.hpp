// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/slam/contradiction_monitor.hpp"
#include "cca_mrpt/slam/correction_count.hpp"
#include "cca_mrpt/slam/graph_back_end.hpp"
#include "cca_mrpt/slam/jump_hypothesis.hpp"
#include "cca_mrpt/slam/key_frames.hpp"
#include "cca_mrpt/slam/map_part.hpp"
#include "cca_mrpt/slam/motion_prior.hpp"
#include "cca_mrpt/slam/odometry_chain.hpp"
#include "cca_mrpt/slam/tracking.hpp"

namespace cca {

/// Where the robot is, as Slam::step() believes.
struct SlamPose {
  Pose2 T_map_robot;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< (x, y) map axes, theta: of the last match
  double agreement = 0.0;       ///< of the scan with what was seen before, [0, 1]
  int version = 0;              ///< counts corrections of the past by more than 5 cm
  /// The scan contradicts what was seen before: nobody knows where in the map it was taken (yet).
  bool is_lost = false;
};

/// A scan that a key frame was made of.
struct KeyScan {
  Scan scan;  ///< T_map_sensor is not used
  Pose2 T_robot_sensor;
};

/// What a drive leaves for the next one through the same place.
struct SlamMemory {
  std::vector<KeyScan> scans;  ///< of each node of the graph
  PoseGraph graph;             ///< of their sensors
};

/// Line SLAM: poses from wheels and laser, with loops.
///
/// The search for loops, and the solution of the graph, are spread over the scans that follow: a
/// loop is closed some scans after the robot has come to it. How many is a matter of counts, never
/// of time.
///
/// A robot whose scans contradict the map for a metre is lost: it begins a part of the graph of its
/// own, and looks for its place in the map, anywhere, until both become one. So does a robot that
/// has been carried away, one that goes on with an earlier map, and a second log of the building.
class Slam {
 public:
  explicit Slam(const Pose2& T_map_start = {}, ScanMatcher matcher = matchSurface)
      : T_map_start_(T_map_start), tracker_(matcher) {}

  /// Lets the map begin with the robot there. To be called before the first scan.
  void startAt(const Pose2& T_map_start) { T_map_start_ = T_map_start; }

  /// @param analysed        T_map_sensor of its scan is not used.
  /// @param T_odom_robot    in any frame that stays; nothing: the robot goes on as it went.
  SlamPose step(const AnalysedScan& analysed, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot);
  /// The same with a scan that nobody has analysed yet.
  SlamPose step(const Scan& scan, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot) {
    return step(analyse(scan), T_robot_sensor, T_odom_robot);
  }

  /// Takes what was left by earlier drives, each a part of its own, before the first scan. The
  /// robot may be anywhere in it or elsewhere: its own drive is the map, until it has found itself
  /// in the earliest of these, and goes on in its frame.
  void remember(const SlamMemory& memory);

  /// From the next scan on the robot may be anywhere: a second log of the same place.
  void startAnywhere() { starts_anywhere_ = map_.hasDriven(frames_.graph); }

  /// The last pass over a whole log: lost parts look for their place once more, the largest part of
  /// the robot's own drive is the map, and all poses are made to agree with all lines.
  /// @param do_all  shares out what can be done at once; see adjust().
  void finish(const DoAll& do_all = doInTurn);

  /// T_map_robot of each scan so far, in order, as the graph has them now; those that are
  /// remembered come first.
  std::vector<Pose2> trajectory() const;
  /// Of each scan so far, whether its pose in the map is known.
  std::vector<bool> isLocalised() const;
  /// Of each scan so far, whether it was set aside: it contradicts what was seen before and after
  /// it, as one of the floor does, and has moved nothing. Those of a lost robot that agree with one
  /// another are not: they are a part of their own.
  std::vector<bool> isSetAside() const;
  /// Whether that of the last one is.
  bool isLost() const { return map_.isLost(frames_.graph); }

  /// Whether the robot has found itself in what it remembers, or remembers nothing.
  bool isInMemory() const { return map_.isInMemory(frames_.graph); }
  /// How many scans are remembered.
  int remembered() const { return map_.remembered(); }
  /// The key frames of the map, for the next drive.
  SlamMemory memory() const;

  /// What the last step, or finish(), did.
  const SlamWork& work() const { return back_end_.work(); }
  /// Whether nothing waits for the next scans.
  bool isSettled() const { return back_end_.isIdle(); }

  const KeyFrames& keyFrames() const { return frames_; }
  const std::vector<LoopVerdict>& loops() const { return back_end_.loopCloser().loops(); }
  const std::vector<LoopVerdict>& verdicts() const { return back_end_.loopCloser().verdicts(); }
  /// How the visits of the map agree with one another, and whether other sets of loops were tried:
  /// of the last finish().
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
  void jump();
  bool takePose(const Tracked& tracked, std::size_t returns);
  int newFrame(const Scan& scan, const Pose2& T_robot_sensor, ScanSurface surface);
  void addKeyFrame(int frame, const GraphEdge& odometry, bool is_measured);
  void learnScale(const GraphEdge& odometry, const GraphEdge& match);
  void startPart(int frame);
  void advanceBackEnd();
  SlamPose poseNow(const Pose2& T_robot_sensor, double agreement) const;

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
