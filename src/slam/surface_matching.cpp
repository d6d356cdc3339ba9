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

/// What lies k beams beside a point is farther from it than k - .5 arcs, less what the sine of that
/// angle is short of it: this share of its square remains up to a radian.
constexpr double kOfArc = 0.7;

/// The nearest return of the reference to a point of its frame, facing as `normal`; -1: none.
/// Beams are asked from the one that looks there outwards, until none can be nearer.
int partnerOf(const ScanSurface& reference, const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
              double reach) {
  const int beam = reference.beamTowards(p);
  if (beam < 0) return -1;
  const int beams = reference.beams();
  int best = -1;
  double nearest = reach * reach;
  const auto ask = [&](int k) {
    if (k < 0 || k >= beams) {
      if (!reference.is_full_turn) return;
      k += k < 0 ? beams : -beams;
    }
    const int i = reference.point_of_beam[static_cast<std::size_t>(k)];
    if (i < 0) return;
    const ScanSurface::Point& point = reference.points[static_cast<std::size_t>(i)];
    const double apart_sq = (point.position - p).squaredNorm();
    if (apart_sq >= nearest || point.normal.dot(normal) < kSameFacing) return;
    nearest = apart_sq;
    best = i;
  };
  ask(beam);
  const double arc_sq = kOfArc * p.squaredNorm() * reference.spacing * reference.spacing;
  for (int k = 1; k <= kWidestSearch && k < beams; ++k) {
    if ((k - 0.5) * (k - 0.5) * arc_sq >= nearest) break;
    ask(beam - k);
    ask(beam + k);
  }
  return best;
}

/// Sums over distances e with the derivatives J = (n, turn): of weight J J' (its upper half),
/// weight e J, weight, and weight e^2.
struct QuadricSums {
  void add(double weight, double e, const Eigen::Vector2d& n, double turn) {
    const double wx = weight * n.x(), wy = weight * n.y(), wt = weight * turn;
    xx += wx * n.x();
    xy += wx * n.y();
    xt += wx * turn;
    yy += wy * n.y();
    yt += wy * turn;
    tt += wt * turn;
    x += wx * e;
    y += wy * e;
    t += wt * e;
    weights += weight;
    squares += weight * e * e;
  }
  void add(const QuadricSums& other, double share) {
    xx += share * other.xx;
    xy += share * other.xy;
    xt += share * other.xt;
    yy += share * other.yy;
    yt += share * other.yt;
    tt += share * other.tt;
    x += share * other.x;
    y += share * other.y;
    t += share * other.t;
    weights += share * other.weights;
    squares += share * other.squares;
  }
  double xx = 0.0, xy = 0.0, xt = 0.0, yy = 0.0, yt = 0.0, tt = 0.0;
  double x = 0.0, y = 0.0, t = 0.0, weights = 0.0, squares = 0.0;
};

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
  QuadricSums all;
  for (std::size_t k = 0; k < query.points.size(); k += static_cast<std::size_t>(scale.stride)) {
    const ScanSurface::Point& point = query.points[k];
    if (point.normal.isZero()) continue;
    const Eigen::Vector2d arm = map_query.turn(point.position);
    QuadricSums own;
    int partners = 0;
    for (std::size_t r = 0; r < references.size(); ++r) {
      const ScanSurface& reference = *references[r].surface;
      const Eigen::Vector2d p = to_reference[r] * point.position;
      const int i = partnerOf(reference, p, to_reference[r].turn(point.normal), scale.reach);
      if (i < 0) continue;
      const ScanSurface::Point& partner = reference.points[static_cast<std::size_t>(i)];
      const double e = partner.normal.dot(p - partner.position);
      const double weight = 1.0 / (1.0 + e * e * weight_of_sigma);
      const Eigen::Vector2d n = to_map[r].turn(partner.normal);
      own.add(weight, e, n, n.y() * arm.x() - n.x() * arm.y());
      ++partners;
    }
    if (partners == 0) continue;
    // Each return counts once, however many references saw its place.
    all.add(own, 1.0 / partners);
    quadric.paired += scale.stride;
  }
  const double information = kIndependent * weight_of_sigma * scale.stride;
  quadric.H << all.xx, all.xy, all.xt, all.xy, all.yy, all.yt, all.xt, all.yt, all.tt;
  quadric.g << all.x, all.y, all.t;
  quadric.H *= information;
  quadric.g *= information;
  quadric.sum_weights = scale.stride * all.weights;
  quadric.sum_sq = scale.stride * all.squares;
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
    const double off_sq = off.dot(prior.information * off);
    const Eigen::Matrix3d held = prior.information / (1.0 + off_sq / kPriorFreedom);
    result.information = quadric.H;
    // As far off as is to be expected the prior is known as well as before: else, where the match
    // says nothing, it would be forgotten by and by.
    result.posterior = quadric.H + prior.information * std::min(1.0, (kPriorFreedom + 3.0) /
                                                                         (kPriorFreedom + off_sq));
    result.paired = query.points.empty() ? 0.0
                                         : static_cast<double>(quadric.paired) /
                                               static_cast<double>(query.points.size());
    if (quadric.sum_weights > 0.0) result.sigma = std::sqrt(quadric.sum_sq / quadric.sum_weights);
    const Eigen::LDLT<Eigen::Matrix3d> solver(Eigen::Matrix3d(quadric.H + held));
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

namespace {

enum class Sight { kAgrees, kContradicts, kUnseen };

/// What the rays of a viewer say of a return at a point of its frame.
Sight sightOf(const ScanSurface& viewer, const Eigen::Vector2d& p, double tolerance) {
  const int beam = viewer.beamTowards(p);
  if (beam < 0) return Sight::kUnseen;
  const int beams = viewer.beams();
  const double range = p.norm();
  double least = 1e9, most = 0.0;
  for (int k = beam - 1; k <= beam + 1; ++k) {
    const int at = k < 0 ? k + beams : k >= beams ? k - beams : k;
    if (!viewer.is_full_turn && at != k) continue;
    const double free = viewer.free_range[static_cast<std::size_t>(at)];
    least = std::min(least, free);
    most = std::max(most, free);
    const int i = viewer.point_of_beam[static_cast<std::size_t>(at)];
    if (i < 0) continue;
    const Eigen::Vector2d& q = viewer.points[static_cast<std::size_t>(i)].position;
    if ((q - p).norm() < tolerance) return Sight::kAgrees;
  }
  // Between the nearest and the farthest of three neighbouring beams a surface may lie anywhere.
  if (range > least - tolerance && range < most + tolerance) return Sight::kAgrees;
  return range <= least - tolerance ? Sight::kContradicts : Sight::kUnseen;
}

}  // namespace

SightCount compareSights(const ScanSurface& viewer, const ScanSurface& other,
                         const Pose2& T_viewer_other, double tolerance) {
  SightCount count;
  const Motion motion(T_viewer_other);
  for (const ScanSurface::Point& point : other.points) {
    switch (sightOf(viewer, motion * point.position, tolerance)) {
      case Sight::kAgrees:
        count.agree += 1.0;
        break;
      case Sight::kContradicts:
        count.contradict += 1.0;
        break;
      case Sight::kUnseen:
        count.unseen += 1.0;
    }
  }
  return count;
}

void forgetWhatMoved(ScanSurface& surface, const Pose2& T_map_sensor,
                     const std::vector<PlacedSurface>& others, double tolerance) {
  std::vector<Motion> to_others;
  for (const PlacedSurface& other : others)
    to_others.emplace_back(other.T_map_sensor.inverse() * T_map_sensor);
  for (ScanSurface::Point& point : surface.points) {
    int balance = 0;
    for (std::size_t i = 0; i < others.size(); ++i) {
      const Sight sight = sightOf(*others[i].surface, to_others[i] * point.position, tolerance);
      balance += (sight == Sight::kContradicts) - (sight == Sight::kAgrees);
    }
    if (balance > 0) point.normal.setZero();
  }
}

}  // namespace cca
