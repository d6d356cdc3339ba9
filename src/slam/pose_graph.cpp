// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/pose_graph.hpp"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <memory>
#include <queue>

namespace cca {
namespace {

/// The error of an edge, weighted by the root of its information, with its derivatives.
class EdgeError : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit EdgeError(const GraphEdge& edge) : measured_(edge.T_from_to) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(edge.information);
    root_ = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
            solver.eigenvectors().transpose();
  }

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const double *a = poses[0], *b = poses[1];
    const double c = std::cos(a[2]), s = std::sin(a[2]);
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const Eigen::Vector3d error(c * dx + s * dy - measured_.x, -s * dx + c * dy - measured_.y,
                                wrapAngle(b[2] - a[2] - measured_.theta));
    Eigen::Map<Eigen::Vector3d> weighted(residuals);
    weighted = root_ * error;
    if (jacobians == nullptr) return true;
    using Jacobian = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    if (jacobians[0] != nullptr) {
      Eigen::Matrix3d J;
      J << -c, -s, -s * dx + c * dy, s, -c, -c * dx - s * dy, 0.0, 0.0, -1.0;
      Eigen::Map<Jacobian> out(jacobians[0]);
      out = root_ * J;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Matrix3d J;
      J << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
      Eigen::Map<Jacobian> out(jacobians[1]);
      out = root_ * J;
    }
    return true;
  }

 private:
  Pose2 measured_;
  Eigen::Matrix3d root_;
};

/// Where no information is, a pose is still no farther off than this.
const Eigen::Vector3d kVague(1e-2, 1e-2, 1e-1);  // 1/m^2, 1/m^2, 1/rad^2

/// The covariance of an edge, the same in all directions, and so in all axes: (m^2, m^2, rad^2).
Eigen::Vector3d spreadOf(const GraphEdge& edge) {
  Eigen::Matrix3d information = edge.information;
  information.diagonal() += kVague;
  const Eigen::Matrix3d covariance = information.inverse();
  const double across = 0.5 * covariance.topLeftCorner<2, 2>().trace();
  return {across, across, covariance(2, 2)};
}

}  // namespace

int PoseGraph::add(const Pose2& T_map_node) {
  poses_.push_back(T_map_node);
  edges_of_.emplace_back();
  return size() - 1;
}

void PoseGraph::connect(const GraphEdge& edge) {
  const int number = static_cast<int>(edges_.size());
  edges_.push_back(edge);
  spreads_.push_back(spreadOf(edge));
  edges_of_[static_cast<std::size_t>(edge.from)].push_back(number);
  edges_of_[static_cast<std::size_t>(edge.to)].push_back(number);
}

std::vector<RelativeCovariance> PoseGraph::surroundings(int node, double most_sigma) const {
  struct Reached {
    double variance;
    int node;
    Eigen::Matrix3d covariance;
    bool operator<(const Reached& other) const {
      return variance != other.variance ? variance > other.variance : node > other.node;
    }
  };
  std::vector<RelativeCovariance> found;
  std::vector<bool> done(poses_.size(), false);
  std::priority_queue<Reached> open;
  open.push({0.0, node, Eigen::Matrix3d::Zero()});
  const Eigen::Matrix2d to_node = Eigen::Rotation2Dd(-pose(node).theta).toRotationMatrix();
  while (!open.empty()) {
    const Reached here = open.top();
    open.pop();
    if (done[static_cast<std::size_t>(here.node)]) continue;
    done[static_cast<std::size_t>(here.node)] = true;
    found.push_back({here.node, here.covariance});
    for (const int number : edges_of_[static_cast<std::size_t>(here.node)]) {
      const GraphEdge& edge = edges_[static_cast<std::size_t>(number)];
      const int next = edge.from == here.node ? edge.to : edge.from;
      if (done[static_cast<std::size_t>(next)]) continue;
      // In the axes of the node that all is seen from; the arm turns heading errors into positions.
      const Eigen::Vector2d arm = to_node * (pose(next).position() - pose(here.node).position());
      Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
      J(0, 2) = -arm.y();
      J(1, 2) = arm.x();
      Eigen::Matrix3d covariance = J * here.covariance * J.transpose();
      covariance.diagonal() += spreads_[static_cast<std::size_t>(number)];
      const double variance = covariance.topLeftCorner<2, 2>().trace();
      if (variance > most_sigma * most_sigma) continue;
      open.push({variance, next, covariance});
    }
  }
  return found;
}

double PoseGraph::optimise() { return optimisePoses(edges_, poses_, 20); }

double PoseGraph::closeLoops() {
  const std::vector<Pose2> before = poses_;
  for (const double wider : {100.0, 10.0, 1.0}) {
    optimisePoses(edges_, poses_, 20, wider * kLoopKernel);
  }
  double largest = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    largest = std::max(largest, (poses_[k].position() - before[k].position()).norm());
  }
  return largest;
}

double optimisePoses(const std::vector<GraphEdge>& edges, std::vector<Pose2>& poses,
                     int most_iterations, double kernel) {
  if (poses.size() < 2 || edges.empty()) return 0.0;
  std::vector<std::array<double, 3>> values(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    values[i] = {poses[i].x, poses[i].y, poses[i].theta};
  ceres::Problem problem;
  for (const GraphEdge& edge : edges) {
    problem.AddResidualBlock(new EdgeError(edge),
                             edge.is_loop ? new ceres::CauchyLoss(kernel) : nullptr,
                             values[static_cast<std::size_t>(edge.from)].data(),
                             values[static_cast<std::size_t>(edge.to)].data());
  }
  if (!problem.HasParameterBlock(values.front().data())) return 0.0;
  problem.SetParameterBlockConstant(values.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // no threads of its own
  options.max_num_iterations = most_iterations;
  options.num_threads = 1;  // the same sums in the same order, whatever the machine
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-5;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 moved{values[i][0], values[i][1], wrapAngle(values[i][2])};
    largest = std::max(largest, (moved.position() - poses[i].position()).norm());
    poses[i] = moved;
  }
  return largest;
}

}  // namespace cca
