// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/mapping/pose2.hpp"

namespace cca {

/// What is known of one pose as seen from another.
struct GraphEdge {
  int from = 0, to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< axes of `from`; may be singular
  bool is_loop = false;  ///< may be wrong: its weight falls with its error
};

/// Where a pose lies as seen from another one, along the surest way through the graph.
struct RelativeCovariance {
  int node = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< axes of the pose it is seen from
};

/// The poses that agree best with what is known of them pair by pair [Konolige et al. 2010].
class PoseGraph {
 public:
  /// @return  its number.
  int add(const Pose2& T_map_node);
  void connect(const GraphEdge& edge);

  int size() const { return static_cast<int>(poses_.size()); }
  const Pose2& pose(int node) const { return poses_[static_cast<std::size_t>(node)]; }
  void place(int node, const Pose2& pose) { poses_[static_cast<std::size_t>(node)] = pose; }
  const std::vector<GraphEdge>& edges() const { return edges_; }

  /// Nodes whose position is known to `most_sigma` [m] from `node`, nearest in that sense first
  /// (Dijkstra; an upper bound of the true covariance, which all ways together give).
  /// Cost: O(n log n) of the nodes found.
  std::vector<RelativeCovariance> surroundings(int node, double most_sigma) const;

  /// Least squares over all poses but the first, which stays. @return the largest move, m.
  /// Cost: a sparse Cholesky factorisation per iteration.
  double optimise();
  /// The same where loops are new, and the poses may be far from what they ask for: the kernel that
  /// forgives errors begins wide and narrows (graduated non-convexity).
  double closeLoops();

 private:
  std::vector<Pose2> poses_;
  std::vector<GraphEdge> edges_;
  std::vector<Eigen::Vector3d> spreads_;    ///< of each edge, for surroundings()
  std::vector<std::vector<int>> edges_of_;  ///< of each node
};

/// Errors of loops are forgiven from so many deviations on (Cauchy).
inline constexpr double kLoopKernel = 3.0;

/// The poses that agree best with all edges, the first held.
/// @param kernel  of loops, deviations.
/// @return        the largest move, m.
double optimisePoses(const std::vector<GraphEdge>& edges, std::vector<Pose2>& poses,
                     int most_iterations, double kernel = kLoopKernel);

}  // namespace cca
