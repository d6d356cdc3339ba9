// SPDX-License-Identifier: BSD-3-Clause
#include "slam/key_frames.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace cca {
namespace {

/// A turn of half a radian costs two scans as much of their common view as a metre.
constexpr double kTurnCost = 2.0;

double apartness(const Pose2& a, const Pose2& b, bool full_turn) {
  const double turn = full_turn ? 0.0 : std::abs(wrapAngle(a.theta - b.theta));
  return (a.position() - b.position()).norm() + kTurnCost * turn;
}

/// Two frames have something to say of each other from so many paired returns on.
constexpr int kLeastPairs = 10;
/// Directions that less than this share of the strongest speaks for are noise of the normals.
constexpr double kWeakest = 0.01;
constexpr std::size_t kPairsOfEach = 7;  // bounds the matches of a frame in an adjustment

}  // namespace

double wayWithTurns(const Pose2& step) {
  return step.position().norm() + kFrameDistance / kFrameTurn * std::abs(step.theta);
}

bool isKeyFrameDue(const Pose2& T_last_now, const ScanSurface& surface) {
  if (surface.points.empty()) return false;
  return T_last_now.position().norm() >= kFrameDistance ||
         (std::abs(T_last_now.theta) >= kFrameTurn && !surface.is_full_turn);
}

std::vector<PlacedSurface> KeyFrames::placed(const std::vector<int>& numbers) const {
  std::vector<PlacedSurface> surfaces_placed;
  for (const int k : numbers) surfaces_placed.push_back(placed(k));
  return surfaces_placed;
}

std::vector<int> framesInView(const KeyFrames& frames, int anchor, const Pose2& T_map_sensor,
                              int most) {
  std::vector<std::pair<double, int>> near;
  for (const RelativeSigma& tied : frames.graph.surroundings(anchor, kTiedSigma)) {
    const Pose2& pose = frames.graph.pose(tied.node);
    if ((pose.position() - T_map_sensor.position()).norm() > 2.0 * kCommonView) continue;
    const bool full = frames.surfaces[static_cast<std::size_t>(tied.node)].is_full_turn;
    near.push_back({apartness(pose, T_map_sensor, full), tied.node});
  }
  std::sort(near.begin(), near.end());
  std::vector<int> found;
  for (std::size_t i = 0; i < near.size() && static_cast<int>(i) < most; ++i) {
    found.push_back(near[i].second);
  }
  return found;
}

std::optional<GraphEdge> matchEdge(const KeyFrames& frames, int from, int to,
                                   const MatchScale& scale) {
  const Pose2 T_from_to = frames.graph.pose(from).inverse() * frames.graph.pose(to);
  const MatchQuadric quadric =
      matchQuadric(frames.surfaces[static_cast<std::size_t>(to)], T_from_to,
                   {{&frames.surfaces[static_cast<std::size_t>(from)], Pose2{}}}, scale);
  if (quadric.paired < kLeastPairs) return std::nullopt;
  const Eigen::Vector3d unit(1.0, 1.0, 1.0 / kTurnArm);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(unit.asDiagonal() * quadric.H * unit.asDiagonal()));
  const double least = kWeakest * solver.eigenvalues().z();
  GraphEdge edge{from, to, T_from_to, Eigen::Matrix3d::Zero(), EdgeKind::kLoop};
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double strength = solver.eigenvalues()(i);
    if (strength < least) continue;
    const Eigen::Vector3d direction = solver.eigenvectors().col(i);
    step -= direction.dot(unit.cwiseProduct(quadric.g)) / strength * unit.cwiseProduct(direction);
    const Eigen::Vector3d across = direction.cwiseQuotient(unit);
    edge.information += strength * across * across.transpose();
  }
  edge.T_from_to.x += step.x();
  edge.T_from_to.y += step.y();
  edge.T_from_to.theta = wrapAngle(edge.T_from_to.theta + step.z());
  return edge;
}

std::vector<FramePair> pairsInView(const KeyFrames& frames, std::size_t of_each) {
  constexpr double kSameVisit = 10.0;  // m of way: wheels still hold the two together
  std::vector<double> way(static_cast<std::size_t>(frames.size()), 0.0);
  for (int k = 1; k < frames.size(); ++k) {
    way[static_cast<std::size_t>(k)] =
        way[static_cast<std::size_t>(k - 1)] +
        (frames.graph.pose(k).position() - frames.graph.pose(k - 1).position()).norm();
  }
  // Frames by cells of the common view, so that only neighbours are asked.
  std::vector<std::pair<std::pair<int, int>, int>> cells;
  const auto cellOf = [&](int k) {
    const Pose2& pose = frames.graph.pose(k);
    return std::pair<int, int>{static_cast<int>(std::floor(pose.x / kCommonView)),
                               static_cast<int>(std::floor(pose.y / kCommonView))};
  };
  for (int k = 0; k < frames.size(); ++k) cells.push_back({cellOf(k), k});
  std::sort(cells.begin(), cells.end());
  std::set<std::tuple<int, int, bool>> pairs;
  for (int k = 0; k < frames.size(); ++k) {
    const auto [cx, cy] = cellOf(k);
    std::vector<std::pair<double, int>> same, other;
    for (int x = cx - 1; x <= cx + 1; ++x) {
      const std::pair<std::pair<int, int>, int> first{{x, cy - 1}, -1};
      for (auto it = std::lower_bound(cells.begin(), cells.end(), first);
           it != cells.end() && it->first.first == x && it->first.second <= cy + 1; ++it) {
        const int m = it->second;
        const Pose2 &a = frames.graph.pose(k), &b = frames.graph.pose(m);
        if (m == k || (a.position() - b.position()).norm() > kCommonView) continue;
        if (frames.graph.part(m) != frames.graph.part(k)) continue;
        const bool same_visit = std::abs(way[static_cast<std::size_t>(m)] -
                                         way[static_cast<std::size_t>(k)]) <= kSameVisit;
        const double apart =
            apartness(a, b, frames.surfaces[static_cast<std::size_t>(k)].is_full_turn);
        (same_visit ? same : other).push_back({apart, m});
      }
    }
    for (auto* list : {&same, &other}) {
      std::sort(list->begin(), list->end());
      if (list->size() > of_each) list->resize(of_each);
      for (const auto& [apart, m] : *list) {
        pairs.insert({std::min(k, m), std::max(k, m), list == &same});
      }
    }
  }
  std::vector<FramePair> found;
  for (const auto& [first, second, is_same_visit] : pairs) {
    found.push_back({first, second, is_same_visit});
  }
  return found;
}

namespace {

/// What two frames say of each other, until they have moved.
class PairEdge {
 public:
  PairEdge(int from, int to) : from_(from), to_(to) {}

  /// @param is_coarse  it is done again, by a narrower reach.
  void match(const KeyFrames& frames, MatchScale scale, bool is_coarse) {
    if (is_coarse) scale.stride = coarseStride(frames.surfaces[static_cast<std::size_t>(to_)]);
    const Pose2 T_from_to = frames.graph.pose(from_).inverse() * frames.graph.pose(to_);
    if (scale.reach == reach_ && isAt(T_from_to)) return;
    T_from_to_ = T_from_to;
    reach_ = scale.reach;
    edge_ = matchEdge(frames, from_, to_, scale);
  }
  const std::optional<GraphEdge>& edge() const { return edge_; }

 private:
  bool isAt(const Pose2& pose) const {
    const Eigen::Vector3d moved = difference(pose, T_from_to_);
    return moved.head<2>().norm() + kTurnArm * std::abs(moved.z()) < kSettled;
  }

  int from_, to_;
  Pose2 T_from_to_;
  double reach_ = 0.0;
  std::optional<GraphEdge> edge_;
};

}  // namespace

void adjust(KeyFrames& frames, int rounds, const DoAll& do_all) {
  constexpr double kNarrows = 0.8;  // slower than a match of one scan: each round moves all poses
  constexpr int kAtOnce = 64;       // matches, so that sharing them out costs nothing
  std::vector<PairEdge> pairs;
  for (const FramePair& pair : pairsInView(frames, kPairsOfEach)) {
    // In both directions: the lines of either are the other's measure.
    pairs.emplace_back(pair.first, pair.second);
    pairs.emplace_back(pair.second, pair.first);
  }
  const int count = static_cast<int>(pairs.size());
  std::vector<GraphEdge> steps;
  for (const GraphEdge& edge : frames.graph.edges()) {
    if (edge.kind == EdgeKind::kWheels) steps.push_back(edge);
  }
  double reach = kFirstMatchReach;
  for (int round = 0; round < rounds; ++round) {
    const MatchScale scale{reach, 0.25 * reach};
    do_all((count + kAtOnce - 1) / kAtOnce, [&](int part) {
      for (int k = part * kAtOnce; k < std::min(count, (part + 1) * kAtOnce); ++k) {
        pairs[static_cast<std::size_t>(k)].match(frames, scale, reach > kFinestReach);
      }
    });
    std::vector<GraphEdge> edges = steps;
    for (const PairEdge& pair : pairs) {
      if (pair.edge()) edges.push_back(*pair.edge());
    }
    std::vector<Pose2> poses;
    for (int k = 0; k < frames.size(); ++k) poses.push_back(frames.graph.pose(k));
    const double moved = optimisePoses(edges, poses, 5);
    for (int k = 0; k < frames.size(); ++k)
      frames.graph.place(k, poses[static_cast<std::size_t>(k)]);
    if (reach <= kFinestReach && moved < 1e-3) break;
    reach = std::max(kFinestReach, kNarrows * reach);
  }
}

}  // namespace cca
