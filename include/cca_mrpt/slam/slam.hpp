// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "cca_mrpt/slam/correlative_search.hpp"
#include "cca_mrpt/slam/key_frames.hpp"
#include "cca_mrpt/slam/loop_closer.hpp"
#include "cca_mrpt/slam/motion_prior.hpp"

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

/// What a step does besides finding its own pose: one thing at the most.
struct SlamWork {
  int searches = 0;  ///< bits of the search for a frame at a visit, or in another part of the graph
  int iterations = 0;  ///< of the least squares over the graph

  SlamWork& operator+=(const SlamWork& other);
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
  /// How a scan is matched to the frames in view; see matchSurface().
  using Matcher = MatchResult (*)(const ScanSurface& query, const Pose2& start,
                                  const PoseBelief& prior,
                                  const std::vector<PlacedSurface>& references, double reach);

  explicit Slam(const Pose2& T_map_start = {}, Matcher matcher = matchSurface)
      : T_map_start_(T_map_start), matcher_(matcher) {}

  /// Lets the map begin with the robot there. To be called before the first scan.
  void startAt(const Pose2& T_map_start) { T_map_start_ = T_map_start; }

  /// @param scan            T_map_sensor is not used.
  /// @param T_odom_robot    in any frame that stays; nothing: the robot goes on as it went.
  SlamPose step(const Scan& scan, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot);

  /// Takes what was left by earlier drives, each a part of its own, before the first scan. The
  /// robot may be anywhere in it or elsewhere: its own drive is the map, until it has found itself
  /// in the earliest of these, and goes on in its frame.
  void remember(const SlamMemory& memory);

  /// From the next scan on the robot may be anywhere: a second log of the same place.
  void startAnywhere() { starts_anywhere_ = frames_.size() > remembered_; }

  /// The last pass over a whole log: lost parts look for their place once more, the largest part of
  /// the robot's own drive is the map, and all poses are made to agree with all lines.
  /// @param do_all  shares out what can be done at once; see adjust().
  void finish(const DoAll& do_all = doInTurn);

  /// T_map_robot of each scan so far, in order, as the graph has them now; those that are
  /// remembered come first.
  std::vector<Pose2> trajectory() const;
  /// Of each scan so far, whether its place in the map is known.
  std::vector<bool> isPlaced() const;
  /// Of each scan so far, whether it was set aside: it contradicts what was seen before and after
  /// it, as one of the floor does, and has moved nothing. Those of a lost robot that agree with one
  /// another are not: they are a part of their own.
  std::vector<bool> isSetAside() const;
  /// Whether that of the last one is.
  bool isLost() const;

  /// Whether the robot has found itself in what it remembers, or remembers nothing.
  bool isInMemory() const;
  /// How many scans are remembered.
  int remembered() const { return remembered_; }
  /// The key frames of the map, for the next drive.
  SlamMemory memory() const;

  /// What the last step, or finish(), did.
  const SlamWork& work() const { return work_; }
  /// Whether nothing waits for the next scans.
  bool isSettled() const { return !settlement_ && !loop_closer_.isSeeking() && places_.empty(); }

  const KeyFrames& keyFrames() const { return frames_; }
  const std::vector<LoopVerdict>& loops() const { return loop_closer_.loops(); }
  const std::vector<LoopVerdict>& verdicts() const { return loop_closer_.verdicts(); }
  int version() const { return version_; }

 private:
  struct Passed {  // a scan, hung on a key frame
    int frame;
    Pose2 T_frame_sensor;
    Pose2 T_robot_sensor;
    bool is_doubtful;  ///< contradicted what was seen before, and was nowhere else either
  };
  /// Scans that contradict what was seen before, in a row.
  struct Doubt {
    std::vector<ScanSurface> surfaces;
    double way = 0.0;             ///< m
    double way_with_turns = 0.0;  ///< m, a turn by which a key frame is due as the way by which one
    Pose2 T_first_last;           ///< of these scans
    bool is_of_one_place = true;  ///< they agree with one another: no people, no floor
    double usual = 0.0;           ///< agreement of the scans before them
  };
  bool isNewPlace(const Pose2& T_map_sensor, const ScanSurface& surface) const;
  int newFrame(const Scan& scan, const Pose2& T_robot_sensor, ScanSurface surface);
  void forgetMovers(int frame);
  /// @param is_told  by wheels: where they are silent, the robot went on as it had.
  void goOn(int frame, const GraphEdge& wheels, bool is_told);
  void learnWay(const GraphEdge& wheels, const GraphEdge& match);
  void measureWaysAnew();
  void startPart(int frame);
  SlamPose poseNow(const Pose2& T_robot_sensor, double agreement) const;
  void countDoubt(bool is_doubtful, const Pose2& step, const ScanSurface& surface);
  bool isLostByDoubt() const;
  double leastAgreement() const;
  bool agreesWithFrame(const ScanSurface& surface, int frame, const Pose2& T_frame_sensor) const;
  std::optional<int> soughtPart(int frame) const;
  int largestPart() const;
  void workOnce();
  std::vector<GraphEdge> soughtOnce();
  void beginSettling(const std::vector<GraphEdge>& loops);
  void takeSettled();
  void tieVisits(int frame);
  void countVersion();
  struct Located {
    MatchResult match;
    double agreement = 0.0;  ///< with the frames in view
    double in_common = 0.0;  ///< sights that these say something of
  };
  /// Where the robot is if it has jumped: recent scans agree there, and not here.
  struct Elsewhere {
    std::vector<Pose2> T_frame_sensor;  ///< of each of these scans, on the last key frame
    double claim = 0.0;                 ///< m, length of the jump
    double way = 0.0;                   ///< m, driven since
  };
  static bool isBelieved(const Elsewhere& elsewhere);
  void moveElsewhere();
  Pose2 searched(const ScanSurface& surface, SearchWindow window) const;
  Located located(const ScanSurface& surface, const PoseBelief& prior, const Pose2& start,
                  double reach) const;
  PoseBelief beliefAfter(const MotionBelief& motion) const;
  Located locatedAbout(const ScanSurface& surface, const PoseBelief& prior) const;
  bool isClearlyBetter(const Located& there, const Located& here) const;
  std::optional<Located> trackElsewhere(const ScanSurface& surface, const MotionBelief& motion,
                                        const PoseBelief& prior, const Located& here);

  Pose2 T_map_start_;
  Matcher matcher_;
  KeyFrames frames_;
  MotionPrior motion_;
  std::vector<KeyScan> key_scans_;
  int remembered_ = 0;  ///< frames of earlier drives, the first ones
  double usual_ = 0.9;  ///< agreement of the scans of late
  Doubt doubt_;
  bool starts_anywhere_ = false;
  int map_part_ = 0;  ///< of the graph, which is the map
  std::vector<Passed> passed_;
  std::vector<int> view_;  ///< frames that the next scans are matched to
  std::optional<Pose2> last_odom_sensor_;
  Pose2 T_map_sensor_;
  std::optional<Elsewhere> elsewhere_;
  // Since the last key frame: what the wheels alone say, and how well.
  Pose2 T_frame_wheels_;
  bool wheels_tell_ = true;  ///< of each scan since
  Eigen::Matrix3d wheels_covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  struct WheelEdge {
    int edge;       ///< of the graph
    double longer;  ///< as its way has been taken, see MotionPrior
  };
  std::vector<WheelEdge> wheel_edges_;
  LoopCloser loop_closer_;
  int version_ = 0;
  std::vector<Pose2> at_version_;  ///< poses of the frames as whoever holds a map knows them
  std::deque<int> places_;  ///< frames whose place in other parts of the graph is to be looked for
  std::optional<Settlement> settlement_;  ///< under way
  std::vector<GraphEdge> closing_;        ///< loops that it is about: in the graph when it is done
  int last_optimised_ = 0;
  bool unsettled_ = false;  ///< the graph has loops that its poses have not been solved for
  SlamWork work_;
};

}  // namespace cca
