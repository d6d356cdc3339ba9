// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

class World;

/// One moment of a run, as the robot had it then; all places in one frame [m].
struct ReplayMoment {
  double time = 0.0;           ///< s; where all have the same, they follow each other every 0.1 s
  double distance = 0.0;       ///< m, driven
  Pose2 T_map_robot;           ///< as believed
  std::optional<Pose2> truth;  ///< where it is known
  std::optional<Eigen::Vector2d> goal;
  std::string reason;                          ///< why it drives there
  std::vector<Eigen::Vector2d> way;            ///< planned, from the robot to the goal
  std::vector<Eigen::Vector2d> frontier = {};  ///< centres of the frontier's cells
};

/// What is kept of a run to be looked at again in replay.html: the robot, its scan, frontier, goal
/// and way at some thousand moments, and each change of the line map between them.
///
/// Numbers are integers (mm, mrad, ms; ranges cm), stored as differences, so that they pack well.
class Replay {
 public:
  /// Above this number of moments every second one is dropped, and only every second one is taken
  /// from there on: a page has 2000 to 4000 moments of a long run, however long.
  static constexpr std::size_t kMostMoments = 4000;
  static constexpr double kFrontierBlock = 0.2;  ///< m; cells of a frontier are shown in blocks

  /// @param title  for people: the log's or the world's name.
  /// @param robot_radius  m, as drawn.
  explicit Replay(std::string title = "", double robot_radius = 0.2)
      : title_(std::move(title)), robot_radius_(robot_radius) {}

  /// Takes a moment, its scan (at its T_map_sensor) and, every so often, the map's lines. Moments
  /// come in order of time; those without finite time and pose are left out.
  /// Cost: size of the scan and of the frontier, and on average that of forty lines.
  void add(const ReplayMoment& moment, const Scan& scan, const LineMap& map);
  /// The same, where who has the map says when its lines are looked at. @param lines  null: not
  /// now.
  void add(const ReplayMoment& moment, const Scan& scan, const std::vector<MapLine>* lines);
  /// The lines as they are now, without a moment more: the robot stands.
  void redraw(const std::vector<MapLine>& lines);
  /// The lines as the run leaves them, exactly.
  void finish(const std::vector<MapLine>& lines);
  /// What there is in truth. @param world  replayWorld().
  void setWorld(std::string world) { world_ = std::move(world); }
  /// @param share  of what can be seen, in [0, 1], seen on the way up to each distance [m].
  void setCoverage(const std::vector<double>& distance, const std::vector<double>& share);

  bool empty() const { return frames_.empty(); }

  /// How much of a run somebody has who follows it. One without generation has nothing.
  struct Mark {
    std::size_t generation = 0;  ///< another one: moments were dropped, what was had is void
    std::size_t frames = 0, decisions = 0, toggles = 0, changes = 0;
    bool has_truth = false, has_times = false;
    bool isBefore(const Mark& later) const;
  };
  Mark mark() const;
  /// What has come since a mark that isBefore() this one: JSON of the form that packed() packs, but
  /// without the world. Cost: that of what has come.
  std::string since(const Mark& mark) const;
  /// The data that a page holds of this run: JSON, deflated, in base64.
  /// @param origin  m, map frame: where the frame of all this lies.
  std::string packed(const Eigen::Vector2d& origin = Eigen::Vector2d::Zero()) const;

 private:
  using Block = std::pair<int, int>;
  using Placed = std::array<std::int64_t, 3>;  // mm, mm, mrad
  struct Laser {
    Placed T_robot_sensor;
    double first, step;  // rad, of the beams that are kept
    std::size_t beams;
    bool operator==(const Laser& other) const;
  };
  struct Frame {
    std::int64_t time, distance;  // ms, mm
    Placed pose, truth;
    std::size_t laser;
    std::vector<int> ranges;  // cm; 0: no return
  };
  struct Decision {
    std::size_t frame;
    std::optional<std::array<std::int64_t, 2>> goal;
    std::string reason;
    std::vector<std::int64_t> way;  // x, y, x, y, ...
    bool saysTheSame(const Decision& other) const;
  };
  struct Toggle {
    std::size_t frame;
    Block block;
  };
  /// What the page shows of a line: ends [mm], support, sigmas [0.01 mm, 0.01 mrad]; support 0: it
  /// is gone.
  struct Shown {
    std::array<std::int64_t, 4> ends{};
    std::int64_t support = 0, sigma_offset = 0, sigma_angle = 0;
  };
  struct LineChange {
    std::size_t frame;
    std::uint64_t id;
    Shown line;
  };
  static Placed placed(const Pose2& pose);
  static Shown shown(const MapLine& line);
  void addScan(const ReplayMoment& moment, const Scan& scan, Frame& frame);
  void decide(const ReplayMoment& moment);
  void drawFrontier(const std::vector<Eigen::Vector2d>& cells);
  bool linesAreDue() const;
  bool hasTimes() const;
  std::string json(const Mark& from, const Eigen::Vector2d& origin, const std::string& world) const;
  void drawLines(const std::vector<MapLine>& lines, std::int64_t smallest_change);
  void dropEverySecond();

  std::string title_;
  double robot_radius_;
  bool has_truth_ = true;
  std::size_t offered_ = 0, stride_ = 1, generation_ = 1;
  std::vector<Laser> lasers_;
  std::vector<Frame> frames_;
  std::vector<Decision> decisions_;
  std::set<Block> frontier_;
  std::vector<Toggle> toggles_;
  std::map<std::uint64_t, Shown> lines_;
  std::vector<LineChange> changes_;
  std::string world_;  ///< replayWorld(); empty: nobody knows
  std::vector<std::int64_t> coverage_distance_, coverage_share_;
};

/// The obstacles of a world as a page shows them: JSON.
std::string replayWorld(const World& world);

/// The same run, with the rooms that its finished map has. @param packed  Replay::packed().
/// @param rooms  of the floor plan, m, in the frame of packed().
std::string withRooms(const std::string& packed, const std::vector<PlanRoom>& rooms);

/// The page: one file that asks nothing of any network. @param runs  one or two, of packed() or
/// withRooms().
std::string replayPage(const std::vector<std::string>& runs);

/// The same page without a run: it asks the server that it comes from for one that goes on.
std::string livePage();

/// The runs of a page, as replayPage() took them.
/// @param name  of the file, for messages. @throws std::runtime_error where there is none.
std::vector<std::string> runsOfReplayPage(const std::string& page, const std::string& name);

}  // namespace cca
