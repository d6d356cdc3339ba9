// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/surface_matching.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// A rigid motion with its sine and cosine taken once.
struct Motion {
  explicit Motion(const Pose2& pose)
      : c(std::cos(pose.theta)), s(std::sin(pose.theta)), x(pose.x), y(pose.y) {}
  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    return {x + c * p.x() - s * p.y(), y + s * p.x() + c * p.y()};
  }
  Eigen::Vector2d turn(const Eigen::Vector2d& v) const {
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  double c, s, x, y;
};

/// Surfaces face the same way within 25 degrees.
constexpr double kSameFacing = 0.9;
/// So many beams to either side are asked for a partner, at most.
constexpr int kWidestSearch = 8;

/// The nearest return of the reference to a point of its frame, facing as `normal`; -1: none.
int partnerOf(const ScanSurface& reference, const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
              double reach) {
  const int beam = reference.beamTowards(p);
  if (beam < 0) return -1;
  const double arc = p.norm() * reference.spacing;
  const int width = arc * kWidestSearch > reach ? static_cast<int>(reach / arc) + 1 : kWidestSearch;
  const int beams = reference.beams();
  int first = beam - width, last = beam + width;
  if (!reference.is_full_turn) {
    first = std::max(first, 0);
    last = std::min(last, beams - 1);
  }
  int best = -1;
  double nearest = reach * reach;
  for (int k = first; k <= last; ++k) {
    const int at = k < 0 ? k + beams : k >= beams ? k - beams : k;
    const int i = reference.point_of_beam[static_cast<std::size_t>(at)];
    if (i < 0) continue;
    const ScanSurface::Point& point = reference.points[static_cast<std::size_t>(i)];
    const double apart_sq = (point.position - p).squaredNorm();
    if (apart_sq >= nearest || point.normal.dot(normal) < kSameFacing) continue;
    nearest = apart_sq;
    best = i;
  }
  return best;
}

/// The reach shrinks by this a round, and so does the kernel, to these at the least.
constexpr double kShrink = 0.7;
constexpr double kLeastReach = 0.1;
constexpr double kReachPerSigma = 4.0;
constexpr int kMostRounds = 12;
/// A tenth of what a match is worth.
constexpr double kSettled = 5e-4, kSettledTurn = 1e-4;

}  // namespace

Eigen::Vector3d difference(const Pose2& b, const Pose2& a) {
  return {b.x - a.x, b.y - a.y, wrapAngle(b.theta - a.theta)};
}

MatchQuadric matchQuadric(const ScanSurface& query, const Pose2& T_map_query,
                          const std::vector<PlacedSurface>& references, const MatchScale& scale) {
  MatchQuadric quadric;
  const Motion map_query(T_map_query);
  std::vector<Motion> to_reference, to_map;
  for (const PlacedSurface& placed : references) {
    to_reference.emplace_back(placed.T_map_sensor.inverse() * T_map_query);
    to_map.emplace_back(placed.T_map_sensor);
  }
  const double weight_of_sigma = 1.0 / (scale.sigma * scale.sigma);
  for (const ScanSurface::Point& point : query.points) {
    if (point.normal.isZero()) continue;
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    const Eigen::Vector2d arm = map_query.turn(point.position);
    double partners = 0.0, weights = 0.0, sum_sq = 0.0;
    for (std::size_t r = 0; r < references.size(); ++r) {
      const ScanSurface& reference = *references[r].surface;
      const Eigen::Vector2d p = to_reference[r] * point.position;
      const int i = partnerOf(reference, p, to_reference[r].turn(point.normal), scale.reach);
      if (i < 0) continue;
      const ScanSurface::Point& partner = reference.points[static_cast<std::size_t>(i)];
      const double e = partner.normal.dot(p - partner.position);
      const double weight = 1.0 / (1.0 + e * e * weight_of_sigma);
      const Eigen::Vector2d n = to_map[r].turn(partner.normal);
      const Eigen::Vector3d J(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y());
      H += weight * J * J.transpose();
      g += weight * e * J;
      weights += weight;
      sum_sq += weight * e * e;
      partners += 1.0;
    }
    if (partners == 0.0) continue;
    // Each return counts once, however many references saw its place.
    const double share = 1.0 / partners;
    quadric.H += share * H;
    quadric.g += share * g;
    quadric.sum_weights += share * weights;
    quadric.sum_sq += share * sum_sq;
    ++quadric.paired;
  }
  const double information = kIndependent * weight_of_sigma;
  quadric.H *= information;
  quadric.g *= information;
  return quadric;
}

MatchResult matchSurface(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                         const std::vector<PlacedSurface>& references, double first_reach) {
  MatchResult result;
  result.T_map_query = start;
  MatchScale scale{first_reach, first_reach / kReachPerSigma};
  const double least = std::max(kLeastReach, kReachPerSigma * query.range_sigma);
  for (int round = 0; round < kMostRounds; ++round) {
    const MatchQuadric quadric = matchQuadric(query, result.T_map_query, references, scale);
    const Eigen::Vector3d off = difference(result.T_map_query, prior.mean);
    const Eigen::Matrix3d held =
        prior.information / (1.0 + off.dot(prior.information * off) / kPriorFreedom);
    result.information = quadric.H;
    result.posterior = quadric.H + held;
    result.paired = query.points.empty() ? 0.0
                                         : static_cast<double>(quadric.paired) /
                                               static_cast<double>(query.points.size());
    if (quadric.sum_weights > 0.0) result.sigma = std::sqrt(quadric.sum_sq / quadric.sum_weights);
    const Eigen::LDLT<Eigen::Matrix3d> solver(result.posterior);
    if (quadric.paired == 0 || solver.info() != Eigen::Success || !solver.isPositive()) break;
    const Eigen::Vector3d step = solver.solve(-(quadric.g + held * off));
    if (!step.allFinite()) break;
    result.T_map_query.x += step.x();
    result.T_map_query.y += step.y();
    result.T_map_query.theta = wrapAngle(result.T_map_query.theta + step.z());
    const bool is_finest = scale.reach <= least;
    if (is_finest && step.head<2>().norm() < kSettled && std::abs(step.z()) < kSettledTurn) break;
    scale.reach = std::max(least, kShrink * scale.reach);
    scale.sigma = scale.reach / kReachPerSigma;
  }
  return result;
}

SightCount& SightCount::operator+=(const SightCount& other) {
  agree += other.agree;
  contradict += other.contradict;
  unseen += other.unseen;
  return *this;
}

double SightCount::agreement() const {
  const double seen = agree + contradict;
  return seen > 0.0 ? agree / seen : 0.0;
}

SightCount compareSights(const ScanSurface& viewer, const ScanSurface& other,
                         const Pose2& T_viewer_other, double tolerance) {
  SightCount count;
  const Motion motion(T_viewer_other);
  const int beams = viewer.beams();
  for (const ScanSurface::Point& point : other.points) {
    const Eigen::Vector2d p = motion * point.position;
    const int beam = viewer.beamTowards(p);
    if (beam < 0) {
      count.unseen += 1.0;
      continue;
    }
    const double range = p.norm();
    double least = 1e9, most = 0.0;
    bool returned_near = false;
    for (int k = beam - 1; k <= beam + 1; ++k) {
      const int at = k < 0 ? k + beams : k >= beams ? k - beams : k;
      if (!viewer.is_full_turn && at != k) continue;
      const double free = viewer.free_range[static_cast<std::size_t>(at)];
      least = std::min(least, free);
      most = std::max(most, free);
      const int i = viewer.point_of_beam[static_cast<std::size_t>(at)];
      if (i < 0) continue;
      const Eigen::Vector2d& q = viewer.points[static_cast<std::size_t>(i)].position;
      returned_near = returned_near || (q - p).norm() < tolerance;
    }
    // Between the nearest and the farthest of three neighbouring beams a surface may lie anywhere.
    if (returned_near || (range > least - tolerance && range < most + tolerance)) {
      count.agree += 1.0;
    } else if (range <= least - tolerance) {
      count.contradict += 1.0;
    } else {
      count.unseen += 1.0;
    }
  }
  return count;
}

}  // namespace cca
