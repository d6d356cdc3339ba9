// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/pose_graph.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "slam/block_cholesky.hpp"

namespace cca {
namespace {

/// Poses, and the direction of each: its cosine and sine are taken once for all its edges.
struct DirectedPoses {
  explicit DirectedPoses(const std::vector<Pose2>& of) : poses(of) {
    headings.reserve(of.size());
    for (const Pose2& pose : of) headings.push_back(pose.heading());
  }
  const std::vector<Pose2>& poses;
  std::vector<Eigen::Vector2d> headings;
};

/// How an edge's error, in the axes of its first pose, changes with both poses.
struct EdgeError {
  EdgeError(const GraphEdge& edge, const DirectedPoses& at)
      : c(at.headings[static_cast<std::size_t>(edge.from)].x()),
        s(at.headings[static_cast<std::size_t>(edge.from)].y()) {
    const Pose2& a = at.poses[static_cast<std::size_t>(edge.from)];
    const Pose2& b = at.poses[static_cast<std::size_t>(edge.to)];
    const double dx = b.x - a.x, dy = b.y - a.y;
    seen = {c * dx + s * dy, -s * dx + c * dy};
    error << seen.x() - edge.T_from_to.x, seen.y() - edge.T_from_to.y,
        wrapAngle(b.theta - a.theta - edge.T_from_to.theta);
    squared = error.dot(edge.information * error);
  }
  Eigen::Matrix3d byFrom() const {
    Eigen::Matrix3d J;
    J << -c, -s, seen.y(), s, -c, -seen.x(), 0.0, 0.0, -1.0;
    return J;
  }
  Eigen::Matrix3d byTo() const {
    Eigen::Matrix3d J;
    J << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
    return J;
  }
  double c, s;
  Eigen::Vector2d seen;  // m, the second pose from the first
  Eigen::Vector3d error;
  double squared;  // in deviations
};

/// Disjoint sets of nodes: each knows an earlier one of its set, the first itself.
int firstOf(const std::vector<int>& before, int node) {
  while (before[static_cast<std::size_t>(node)] != node)
    node = before[static_cast<std::size_t>(node)];
  return node;
}

void join(std::vector<int>& before, int a, int b) {
  const int first = firstOf(before, a), second = firstOf(before, b);
  before[static_cast<std::size_t>(std::max(first, second))] = std::min(first, second);
}

/// m; poses that a kernel however wide moves by less agree with their loops already.
constexpr double kAgreed = 0.05;
/// m; after a step of less, what is left is its square.
constexpr double kPrecise = 2e-3;
constexpr int kMostIterations = 20;  // bounds the time where loops contradict one another

/// The least squares over a graph, linearised about its poses: Levenberg-Marquardt, where a loop's
/// weight falls with its error (Cauchy).
class GraphSolver {
 public:
  GraphSolver(const std::vector<GraphEdge>& edges, const std::vector<Pose2>& poses, double kernel)
      : edges_(edges),
        kernel_sq_(kernel * kernel),
        is_held_(poses.size(), true),
        poses_(poses),
        H_(static_cast<int>(poses.size()), pairsOf(edges)) {
    std::vector<int> before(poses.size());
    std::iota(before.begin(), before.end(), 0);
    for (const GraphEdge& edge : edges) join(before, edge.from, edge.to);
    for (std::size_t k = 0; k < poses.size(); ++k) is_held_[k] = before[k] == static_cast<int>(k);
    slots_.reserve(edges.size());
    for (const GraphEdge& edge : edges) slots_.push_back(H_.slotOf(edge.from, edge.to));
    cost_ = costOf(poses_);
  }

  void setKernel(double kernel) {
    kernel_sq_ = kernel * kernel;
    cost_ = costOf(poses_);
  }

  /// Tries a step towards the least cost. @return the largest move, m; 0: there is nothing to gain;
  /// nothing: the step led uphill, and the next one will be shorter.
  std::optional<double> attempt() {
    const auto step = solved();
    std::vector<Pose2> moved = poses_;
    double largest = 0.0;
    for (std::size_t k = 0; k < step.size(); ++k) {
      moved[k].x += step[k].x();
      moved[k].y += step[k].y();
      moved[k].theta = wrapAngle(moved[k].theta + step[k].z());
      largest = std::max(largest, step[k].head<2>().norm());
    }
    const double cost = costOf(moved);
    if (cost < cost_) {
      poses_ = std::move(moved);
      cost_ = cost;
      damping_ = std::max(kLeastDamping, damping_ / kMoreDamping);
      failures_ = 0;
      return largest;
    }
    if ((!step.empty() && largest < kPrecise) || ++failures_ >= kMostFailures) {
      failures_ = 0;
      return 0.0;
    }
    damping_ *= kMoreDamping;
    return std::nullopt;
  }

  /// One step towards the least cost. @return the largest move, m; 0: there is nothing to gain.
  double iterate() {
    for (;;) {
      if (const auto moved = attempt()) return *moved;
    }
  }

  const std::vector<Pose2>& poses() const { return poses_; }

 private:
  /// Of the diagonal: nearly Gauss-Newton at first; a step that fails is tried with ten times as
  /// much, up to 10^4, where it hardly moves.
  static constexpr double kFirstDamping = 1e-4, kLeastDamping = 1e-7, kMoreDamping = 10.0;
  static constexpr int kMostFailures = 8;  // from the first damping to 10^4
  static constexpr double kHeld = 1e-6;    // of what the damping is a share of, at least

  static std::vector<std::pair<int, int>> pairsOf(const std::vector<GraphEdge>& edges) {
    std::vector<std::pair<int, int>> pairs;
    pairs.reserve(edges.size());
    for (const GraphEdge& edge : edges) pairs.emplace_back(std::minmax(edge.from, edge.to));
    return pairs;
  }

  double costOf(const std::vector<Pose2>& poses) const {
    double cost = 0.0;
    const DirectedPoses directed(poses);
    for (const GraphEdge& edge : edges_) {
      const double squared = EdgeError(edge, directed).squared;
      cost +=
          edge.kind == EdgeKind::kLoop ? kernel_sq_ * std::log1p(squared / kernel_sq_) : squared;
    }
    return cost;
  }

  /// The step of each pose; empty where there is none.
  std::vector<Eigen::Vector3d> solved() {
    std::vector<Eigen::Vector3d> g(poses_.size(), Eigen::Vector3d::Zero());
    H_.setZero();
    const DirectedPoses directed(poses_);
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const GraphEdge& edge = edges_[k];
      const EdgeError at(edge, directed);
      const double weight =
          edge.kind == EdgeKind::kLoop ? 1.0 / (1.0 + at.squared / kernel_sq_) : 1.0;
      const Eigen::Matrix3d information = weight * edge.information;
      const Eigen::Matrix3d from = at.byFrom(), to = at.byTo();
      const Eigen::Matrix3d from_weighted = from.transpose() * information;
      const Eigen::Matrix3d to_weighted = to.transpose() * information;
      const bool moves_from = !is_held_[static_cast<std::size_t>(edge.from)];
      const bool moves_to = !is_held_[static_cast<std::size_t>(edge.to)];
      if (moves_from) {
        H_.diagonal(edge.from).noalias() += from_weighted * from;
        g[static_cast<std::size_t>(edge.from)].noalias() -= from_weighted * at.error;
      }
      if (moves_to) {
        H_.diagonal(edge.to).noalias() += to_weighted * to;
        g[static_cast<std::size_t>(edge.to)].noalias() -= to_weighted * at.error;
      }
      if (moves_from && moves_to) H_.add(slots_[k], from_weighted * to);
    }
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      Eigen::Matrix3d& own = H_.diagonal(static_cast<int>(k));
      if (is_held_[k]) {
        own.setIdentity();
      } else {
        own.diagonal() += damping_ * own.diagonal().cwiseMax(kHeld);
      }
    }
    if (!H_.factorise()) return {};
    H_.solve(g);
    return g;
  }

  const std::vector<GraphEdge>& edges_;
  double kernel_sq_;
  std::vector<bool> is_held_;  // the first of each part
  std::vector<Pose2> poses_;
  BlockCholesky H_;
  std::vector<BlockCholesky::Slot> slots_;  // of the edges
  double cost_ = 0.0;
  double damping_ = kFirstDamping;
  int failures_ = 0;
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
  ties_.emplace_back();
  before_.push_back(size() - 1);
  return size() - 1;
}

void PoseGraph::connect(const GraphEdge& edge) {
  edges_.push_back(edge);
  const Eigen::Vector3d spread = spreadOf(edge);
  ties_[static_cast<std::size_t>(edge.from)].push_back({edge.to, spread});
  ties_[static_cast<std::size_t>(edge.to)].push_back({edge.from, spread});
  join(before_, edge.from, edge.to);
}

void PoseGraph::lengthen(int edge, double factor) {
  Pose2& T = edges_[static_cast<std::size_t>(edge)].T_from_to;
  T.x *= factor;
  T.y *= factor;
}

int PoseGraph::part(int node) const { return firstOf(before_, node); }

void PoseGraph::movePart(int part, const Pose2& T) {
  for (int k = part; k < size(); ++k) {
    if (this->part(k) == part) place(k, T * pose(k));
  }
}

std::vector<RelativeSigma> PoseGraph::surroundings(int node, double most_sigma) const {
  struct Reached {
    double variance;
    int node;
    bool operator<(const Reached& other) const {
      return variance != other.variance ? variance > other.variance : node > other.node;
    }
  };
  struct Known {        // of a node so far: what matters of its covariance, in the axes of the map
    double variance;    // m^2, of x and y together
    double turn = 0.0;  // rad^2
    Eigen::Vector2d with_turn = Eigen::Vector2d::Zero();  // m rad, of the position with the heading
    bool is_done = false;
  };
  std::vector<Known> known(poses_.size(), Known{most_sigma * most_sigma});
  known[static_cast<std::size_t>(node)].variance = 0.0;
  std::vector<RelativeSigma> found;
  std::priority_queue<Reached> open;
  open.push({0.0, node});
  while (!open.empty()) {
    Known& here = known[static_cast<std::size_t>(open.top().node)];
    const int number = open.top().node;
    open.pop();
    if (here.is_done) continue;
    here.is_done = true;
    found.push_back({number, std::sqrt(0.5 * here.variance), std::sqrt(here.turn)});
    for (const auto& [next_number, spread] : ties_[static_cast<std::size_t>(number)]) {
      Known& next = known[static_cast<std::size_t>(next_number)];
      if (next.is_done) continue;
      // The arm turns heading errors into positions.
      const Eigen::Vector2d arm = pose(next_number).position() - pose(number).position();
      const Eigen::Vector2d turned(-arm.y(), arm.x());
      const double variance = here.variance + 2.0 * turned.dot(here.with_turn) +
                              here.turn * turned.squaredNorm() + spread.x() + spread.y();
      if (variance > next.variance) continue;
      next.variance = variance;
      next.turn = here.turn + spread.z();
      next.with_turn = here.with_turn + here.turn * turned;
      open.push({variance, next_number});
    }
  }
  return found;
}

void PoseGraph::settle(bool has_new_loops) {
  Settlement settlement(*this, has_new_loops);
  while (!settlement.advance()) continue;
  settlement.applyTo(*this);
}

struct Settlement::State {
  PoseGraph graph;
  std::vector<double> kernels;  // left, the last one first
  std::optional<GraphSolver> solver;
  int iterations = kMostIterations;
  bool is_settled = true;  // by this kernel, none has moved anything
};

Settlement::Settlement(const PoseGraph& graph, bool has_new_loops)
    : state_(std::make_unique<State>()) {
  state_->graph = graph;
  state_->kernels = {kLoopKernel};
  if (has_new_loops) state_->kernels = {kLoopKernel, 10.0 * kLoopKernel, 100.0 * kLoopKernel};
}
Settlement::~Settlement() = default;
Settlement::Settlement(const Settlement& other) : state_(std::make_unique<State>(*other.state_)) {}
Settlement& Settlement::operator=(const Settlement& other) {
  state_ = std::make_unique<State>(*other.state_);
  return *this;
}
Settlement::Settlement(Settlement&&) noexcept = default;
Settlement& Settlement::operator=(Settlement&&) noexcept = default;

bool Settlement::advance() {
  State& s = *state_;
  if (s.graph.size() < 2 || s.graph.edges().empty()) return true;
  if (!s.solver) {  // a step's worth of work on its own
    std::vector<Pose2> poses;
    for (int k = 0; k < s.graph.size(); ++k) poses.push_back(s.graph.pose(k));
    s.solver.emplace(s.graph.edges(), poses, s.kernels.back());
    return false;
  }
  const std::optional<double> moved = s.solver->attempt();
  if (!moved) return false;
  --s.iterations;
  s.is_settled = s.is_settled && *moved <= kAgreed;
  if (*moved > kAgreed && s.iterations > 0) return false;
  // A kernel that moves nothing leaves nothing to the narrower ones between it and the last.
  if (s.is_settled && s.kernels.size() > 1) s.kernels.resize(2);
  s.kernels.pop_back();
  if (s.kernels.empty() || s.iterations == 0) return true;
  s.is_settled = true;
  s.solver->setKernel(s.kernels.back());
  return false;
}

void Settlement::applyTo(PoseGraph& graph) const {
  if (!state_->solver) return;
  const std::vector<Pose2>& poses = state_->solver->poses();
  const int settled = static_cast<int>(poses.size());
  for (int k = settled; k < graph.size(); ++k) {
    int last = settled - 1;
    while (last >= 0 && graph.part(last) != graph.part(k)) --last;
    if (last < 0) continue;  // a part that has begun since
    const Pose2 T = poses[static_cast<std::size_t>(last)] * graph.pose(last).inverse();
    graph.place(k, T * graph.pose(k));
  }
  for (int k = 0; k < settled; ++k) graph.place(k, poses[static_cast<std::size_t>(k)]);
}

double optimisePoses(const std::vector<GraphEdge>& edges, std::vector<Pose2>& poses,
                     int most_iterations) {
  if (poses.size() < 2 || edges.empty()) return 0.0;
  GraphSolver solver(edges, poses, kLoopKernel);
  for (int k = 0; k < most_iterations && solver.iterate() > kPrecise; ++k) continue;
  double largest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    largest = std::max(largest, (solver.poses()[i].position() - poses[i].position()).norm());
  }
  poses = solver.poses();
  return largest;
}

}  // namespace cca
