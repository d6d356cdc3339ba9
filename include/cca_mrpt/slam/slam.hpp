// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/sensing/analysed_scan.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"
#include "cca_mrpt/slam/pose_graph.hpp"
#include "cca_mrpt/slam/scan_matcher.hpp"

namespace cca {

struct KeyFrames;
struct LoopReview;
struct LoopVerdict;
struct SlamWork;

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
  /// Matches scans by matchSurface().
  explicit Slam(const Pose2& T_map_start = {});
  Slam(const Pose2& T_map_start, ScanMatcher matcher);
  ~Slam();
  Slam(const Slam& other);
  Slam& operator=(const Slam& other);
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// Lets the map begin with the robot there. To be called before the first scan.
  void startAt(const Pose2& T_map_start);

  /// @param analysed        T_map_sensor of its scan is not used.
  /// @param T_odom_robot    in any frame that stays; nothing: the robot goes on as it went.
  SlamPose step(const AnalysedScan& analysed, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot);
  /// The same with a scan that nobody has analysed yet.
  SlamPose step(const Scan& scan, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot);

  /// The motion of the sensor within the sweep of the next scan: that which was undone, corrected
  /// by what the scan, bent by the error of it, shows of what was seen before. To be asked before
  /// step(), to which the scan goes undone anew. Nothing where the scan says nothing of it. Cost:
  /// some four matches.
  std::optional<SweepHalves> sweepMotion(const AnalysedScan& analysed, const SweptScan& sweep,
                                         const Pose2& T_robot_sensor,
                                         const std::optional<Pose2>& T_odom_robot);

  /// Takes what was left by earlier drives, each a part of its own, before the first scan. The
  /// robot may be anywhere in it or elsewhere: its own drive is the map, until it has found itself
  /// in the earliest of these, and goes on in its frame.
  void remember(const SlamMemory& memory);

  /// From the next scan on the robot may be anywhere: a second log of the same place.
  void startAnywhere();

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
  bool isLost() const;

  /// Whether the robot has found itself in what it remembers, or remembers nothing.
  bool isInMemory() const;
  /// How many scans are remembered.
  int remembered() const;
  /// The key frames of the map, for the next drive.
  SlamMemory memory() const;

  /// What the last step, or finish(), did.
  const SlamWork& work() const;
  /// Whether nothing waits for the next scans.
  bool isSettled() const;

  const KeyFrames& keyFrames() const;
  /// Of the sensors of all key frames.
  const PoseGraph& graph() const;
  /// Those that are believed, and how many.
  const std::vector<LoopVerdict>& loops() const;
  std::size_t loopsClosed() const;
  /// Of all that were looked at.
  const std::vector<LoopVerdict>& verdicts() const;
  /// How the visits of the map agree with one another, and whether other sets of loops were tried:
  /// of the last finish().
  const LoopReview& review() const;
  int version() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace cca
