// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

enum class EdgeKind {
  kWheels,  ///< what the wheels say, from one key frame to the next
  kMatch,   ///< two scans of one visit
  kLoop,    ///< two visits of a place: may be wrong, and its weight falls with its error
};

/// What is known of one pose as seen from another.
struct GraphEdge {
  int from = 0, to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< axes of `from`; may be singular
  EdgeKind kind = EdgeKind::kMatch;
};

/// How well a pose is known as seen from another one, along the surest way through the graph.
struct RelativeSigma {
  int node = 0;
  double position = 0.0;  ///< m, of one axis in the mean
  double turn = 0.0;      ///< rad
};

/// The poses that agree best with what is known of them pair by pair [Konolige et al. 2010].
class PoseGraph {
 public:
  /// @return  its number.
  int add(const Pose2& T_map_node);
  void connect(const GraphEdge& edge);

  int size() const { return static_cast<int>(poses_.size()); }
  const Pose2& pose(int node) const { return poses_[static_cast<std::size_t>(node)]; }
  /// Scales how far one of the edges says that it leads.
  void lengthen(int edge, double factor);
  void place(int node, const Pose2& pose) { poses_[static_cast<std::size_t>(node)] = pose; }
  const std::vector<GraphEdge>& edges() const { return edges_; }
  /// The first node of those that edges tie to this one: two nodes are in one part of the graph
  /// where these are the same.
  int part(int node) const;
  /// Moves a whole part, as one body: pose <- T * pose.
  void movePart(int part, const Pose2& T);

  /// Nodes whose position is known to `most_sigma` [m] from `node`, nearest in that sense first
  /// (Dijkstra; an upper bound of the true covariance, which all ways together give).
  /// Cost: O(n log n) of the nodes found.
  std::vector<RelativeSigma> surroundings(int node, double most_sigma) const;

  /// Least squares over all poses, at once; see Settlement.
  void settle(bool has_new_loops);

 private:
  std::vector<Pose2> poses_;
  std::vector<GraphEdge> edges_;
  struct Tie {  // an edge, for surroundings()
    int node;
    Eigen::Vector3d spread;
  };
  std::vector<std::vector<Tie>> ties_;  ///< of each node
  std::vector<int> before_;  ///< an earlier node of its part, or itself where it is the first
};

/// Least squares over all poses of a graph but the first of each part, which stays: Gauss-Newton
/// steps until no pose moves by more than 5 cm, one at a time, while the graph itself goes on as it
/// is, and grows.
class Settlement {
 public:
  /// @param graph          as it is now, with all edges that are asked.
  /// @param has_new_loops  the poses may be far from what these ask for: the kernel that forgives
  ///                       their errors begins wide and narrows (graduated non-convexity).
  Settlement(const PoseGraph& graph, bool has_new_loops);
  ~Settlement();
  Settlement(const Settlement& other);
  Settlement& operator=(const Settlement& other);
  Settlement(Settlement&&) noexcept;
  Settlement& operator=(Settlement&&) noexcept;

  /// One trial of a step. @return whether all is settled, and nothing more to do.
  /// Cost: a sparse Cholesky factorisation.
  bool advance();

  /// Gives the poses found to the graph it was begun with; nodes that have come since go along with
  /// the last earlier one of their part.
  void applyTo(PoseGraph& graph) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Errors of loops are forgiven from so many deviations on (Cauchy).
inline constexpr double kLoopKernel = 3.0;

/// The poses that agree best with all edges, the first of each part held.
/// @return  the largest move, m.
double optimisePoses(const std::vector<GraphEdge>& edges, std::vector<Pose2>& poses,
                     int most_iterations);

}  // namespace cca
