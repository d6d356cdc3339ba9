// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "navigation/control/tangent_bug/tangent_graph.hpp"
#include "sensing/local_view.hpp"

namespace cca {

/// A place on the boundary of the configuration space.
struct BoundaryPoint {
  Eigen::Vector2d center_map;  ///< m, of the robot touching the obstacle
  int obstacle = 0;            ///< that it touches
  double length = 0.0;         ///< m, along the boundary from the trace's start
  double heading = 0.0;        ///< rad, of the motion, unwrapped along the trace
};

/// Rolls the robot's disc along the obstacle points, from the place nearest to `start_map`.
///
/// The disc turns around the point that it touches until it touches another one, and so on: an
/// exact walk along the union of discs, whatever order or spacing the points have. Headings count
/// whole turns: +2 pi for a closed loop walked counter-clockwise.
///
/// @param on_the_right  the obstacle lies on the right of the motion.
/// @param longest       m. @param goes_on  asked at each new place; false ends the trace before it.
/// @return  points at most 20 degrees of arc apart; empty where there is no obstacle.
/// Cost: O(touched points * obstacles).
std::vector<BoundaryPoint> traceBoundary(
    const ConfigurationSpace& space, const Eigen::Vector2d& start_map, bool on_the_right,
    double longest, const std::function<bool(const Eigen::Vector2d&)>& goes_on);

/// The proof that a boundary has been circled: the walk along it stands again where it stood
/// before, a whole turn (2 pi of heading, either way) later. The winding tells a loop from the way
/// back along the other side of a corridor; the length tells it from standing still.
class LoopDetector {
 public:
  /// @param p_map    m, on the boundary. @param length  m, walked along it.
  /// @param heading  rad, of the walk, unwrapped.
  void add(const Eigen::Vector2d& p_map, double length, double heading);
  void reset() { *this = {}; }

  bool closed() const { return closed_; }

 private:
  struct Place {
    Eigen::Vector2d p_map;
    double length, heading;
  };
  std::vector<Place> places_;
  double again_since_ = -1.0;  ///< m, where the walk came upon its own traces; below 0: it did not
  bool closed_ = false;
};

/// Boundary following [Kamon, Rimon & Rivlin 1998, Sec. 3]: along the obstacle in one direction,
/// by the shortest way that is in sight, keeping d_followed and the proof of having been all
/// around.
///
/// The boundary in sight is traced from where the robot stands beside it; the robot heads for the
/// farthest place of the trace to which the straight way is free, and so cuts its pockets.
class BoundaryFollower {
 public:
  /// Follows the boundary through the place of the configuration space nearest to `start_map`.
  /// d_followed starts as the least distance to the goal of all its places in sight, both ways.
  /// @param space  for tracing, seen from the present view.
  void start(const Eigen::Vector2d& start_map, bool on_the_right, const Eigen::Vector2d& goal_map,
             const LocalView& view, const ConfigurationSpace& space);

  /// @param trace_space  for tracing; @param way_space  with a slightly smaller radius, for ways.
  /// @param d_reach  m, at this step.
  /// @return the place to head for; none where the boundary is no longer in sight.
  std::optional<Eigen::Vector2d> step(const Eigen::Vector2d& goal_map, const LocalView& view,
                                      const ConfigurationSpace& trace_space,
                                      const ConfigurationSpace& way_space, double d_reach);

  bool onTheRight() const { return on_the_right_; }
  static constexpr double kBeside = 1.0;  ///< m; a boundary that is farther off is another one
  double followedDistance() const { return d_followed_; }  ///< d_followed, m
  /// Whether the boundary has been circled, and its place nearest to the goal been looked at:
  /// d_reach has come close to d_followed. Where a short cut passed that place by, a second round
  /// keeps close to the boundary.
  bool hasLooped() const;
  double length() const { return length_; }                           ///< m, followed so far
  const std::vector<BoundaryPoint>& trace() const { return trace_; }  ///< in sight, from the robot

  /// A place a little ahead, on the obstacle's side, of all that the traces since the last call
  /// would have gone through: where the robot gets nowhere, that gap is too narrow after all.
  std::optional<Eigen::Vector2d> takeNarrowPlace();

 private:
  void include(const std::vector<BoundaryPoint>& trace, const Eigen::Vector2d& goal_map);
  void include(const Eigen::Vector2d& p_map, const Eigen::Vector2d& goal_map);
  bool lookedAtNearest() const;
  bool findAnchor(const LocalView& view, const ConfigurationSpace& space);
  void noteNarrowPlace();
  void moveAnchor(const Eigen::Vector2d& x_map, const Eigen::Vector2d& goal_map, std::size_t last);

  bool on_the_right_ = true;
  double length_ = 0.0, heading_ = 0.0;  ///< of the walk, at the anchor
  double d_followed_ = 0.0;
  double least_reach_ = 0.0;  ///< m, the least d_reach of this following
  bool closely_ = false;
  LoopDetector loop_;
  std::vector<BoundaryPoint> trace_;
  std::size_t anchor_ = 0;  ///< of the trace
  std::optional<Eigen::Vector2d> narrow_map_;
  double narrow_turn_ = 0.0;
};

}  // namespace cca
