// SPDX-License-Identifier: BSD-3-Clause
#include "peers/scan_matchers.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "evaluation/spatial_index.hpp"
#include "geometry/cross.hpp"

namespace cca::peers {
namespace {

constexpr int kMostRounds = 40;
constexpr double kSettled = 1e-4;        // m, rad
constexpr double kBearingNoise = 0.005;  // rad
constexpr double kFirstWindow = 0.2;     // rad, of IDC's bearings; falls by kWindowDecay a round
constexpr double kWindowDecay = 0.3, kLeastWindow = 0.01;
constexpr double kKept = 0.9;  // of PL-ICP's pairs

/// Returns of all references in the map frame.
struct Returns {
  explicit Returns(const std::vector<PlacedSurface>& references) {
    for (const PlacedSurface& placed : references) {
      for (const ScanSurface::Point& point : placed.surface->points) {
        positions.push_back(placed.T_map_sensor * point.position);
        covariances.push_back(noise(point, placed.T_map_sensor.theta, *placed.surface));
      }
    }
  }

  /// Of a return [Pfister 2002]: noise along and across the beam, and along the surface the gap to
  /// the next beam, which nobody knows where in it the partner lies.
  static Eigen::Matrix2d noise(const ScanSurface::Point& point, double theta,
                               const ScanSurface& surface) {
    const double range = point.position.norm();
    const Eigen::Vector2d beam = point.position / std::max(range, 1e-9);
    const Eigen::Vector2d across(-beam.y(), beam.x());
    const double along_sq = surface.range_sigma * surface.range_sigma;
    const double across_sq = std::pow(range * kBearingNoise, 2);
    Eigen::Matrix2d covariance =
        along_sq * beam * beam.transpose() + across_sq * across * across.transpose();
    if (!point.normal.isZero()) {
      const Eigen::Vector2d surface_axis(-point.normal.y(), point.normal.x());
      const double incidence = std::max(0.1, std::abs(point.normal.dot(beam)));
      const double gap = range * surface.spacing / incidence;
      covariance += gap * gap / 3.0 * surface_axis * surface_axis.transpose();
    }
    Eigen::Matrix2d R;
    R << std::cos(theta), -std::sin(theta), std::sin(theta), std::cos(theta);
    return R * covariance * R.transpose();
  }

  std::vector<Eigen::Vector2d> positions;
  std::vector<Eigen::Matrix2d> covariances;
};

/// Numbers of the nearest two points within reach; -1 for none.
std::pair<int, int> nearestTwo(const Returns& returns, const PointIndex& index,
                               const Eigen::Vector2d& p, double reach,
                               std::vector<std::size_t>& found) {
  index.within(p, reach, found);
  std::pair<int, int> two{-1, -1};
  double first = reach * reach, second = first;
  std::sort(found.begin(), found.end());
  for (const std::size_t k : found) {
    const double apart_sq = (returns.positions[k] - p).squaredNorm();
    if (apart_sq < first) {
      second = first;
      two = {static_cast<int>(k), two.first};
      first = apart_sq;
    } else if (apart_sq < second) {
      second = apart_sq;
      two.second = static_cast<int>(k);
    }
  }
  return two;
}

/// What the graph makes of a match is the same for all of them.
MatchResult judged(const ScanSurface& query, const Pose2& T_map_query, const PoseBelief& prior,
                   const std::vector<PlacedSurface>& references) {
  constexpr MatchScale kFinest{0.1, 0.025};
  const MatchQuadric quadric = matchQuadric(query, T_map_query, references, kFinest);
  MatchResult result;
  result.T_map_query = T_map_query;
  result.information = quadric.H;
  result.posterior = quadric.H + prior.information;
  if (quadric.sum_weights > 0.0) result.sigma = std::sqrt(quadric.sum_sq / quadric.sum_weights);
  if (!query.points.empty()) {
    result.paired = static_cast<double>(quadric.paired) / static_cast<double>(query.points.size());
  }
  return result;
}

/// Of points and their partners, the motion that brings the first onto the second [Horn 1987].
struct PointPairs {
  std::vector<Eigen::Vector2d> points, partners;

  double turn() const {
    const auto [mean, to] = means();
    double along = 0.0, across = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      along += (points[k] - mean).dot(partners[k] - to);
      across += cross(points[k] - mean, partners[k] - to);
    }
    return std::atan2(across, along);
  }

  std::pair<Eigen::Vector2d, Eigen::Vector2d> means() const {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < points.size(); ++k) {
      mean += points[k];
      to += partners[k];
    }
    const double count = static_cast<double>(points.size());
    return {mean / count, to / count};
  }
};

/// The point of a reference whose range is nearest to that of p within a window of bearings; -1:
/// none. p: frame of the reference.
int sameRange(const ScanSurface& reference, const Eigen::Vector2d& p, double window, double reach) {
  const int beam = reference.beamTowards(p);
  if (beam < 0) return -1;
  const int width = static_cast<int>(window / reference.spacing);
  int best = -1;
  double least = reach;
  for (int k = beam - width; k <= beam + width; ++k) {
    const int beams = reference.beams();
    const int at = reference.is_full_turn ? (k + beams) % beams : k;
    if (at < 0 || at >= beams) continue;
    const int i = reference.point_of_beam[static_cast<std::size_t>(at)];
    if (i < 0) continue;
    const double off =
        std::abs(reference.points[static_cast<std::size_t>(i)].position.norm() - p.norm());
    if (off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

/// One step of Gauss-Newton, turning about the sensor. @return whether it was a small one.
bool stepBy(const Eigen::Matrix3d& H, const Eigen::Vector3d& g, Pose2& pose) {
  const Eigen::Vector3d step = H.ldlt().solve(-g);
  if (!step.allFinite()) return true;
  pose = {pose.x + step.x(), pose.y + step.y(), wrapAngle(pose.theta + step.z())};
  return step.cwiseAbs().maxCoeff() < kSettled;
}

Eigen::Matrix<double, 2, 3> jacobian(const Pose2& pose, const Eigen::Vector2d& p_map) {
  Eigen::Matrix<double, 2, 3> J;
  J << 1.0, 0.0, pose.y - p_map.y(), 0.0, 1.0, p_map.x() - pose.x;
  return J;
}

void hold(const PoseBelief& prior, const Pose2& pose, Eigen::Matrix3d& H, Eigen::Vector3d& g) {
  H += prior.information;
  g += prior.information * difference(pose, prior.mean);
}

}  // namespace

MatchResult matchByDualCorrespondence(const ScanSurface& query, const Pose2& start,
                                      const PoseBelief& prior,
                                      const std::vector<PlacedSurface>& references, double reach) {
  const Returns returns(references);
  const PointIndex index(returns.positions);
  Pose2 pose = start;
  std::vector<std::size_t> found;
  for (int round = 0; round < kMostRounds && !references.empty(); ++round) {
    const double window = std::max(kLeastWindow, kFirstWindow * std::exp(-kWindowDecay * round));
    PointPairs nearest, ranged;
    const PlacedSurface& reference = references.front();
    for (const ScanSurface::Point& point : query.points) {
      const Eigen::Vector2d p = pose * point.position;
      const int partner = nearestTwo(returns, index, p, reach, found).first;
      if (partner >= 0) {
        nearest.points.push_back(p);
        nearest.partners.push_back(returns.positions[static_cast<std::size_t>(partner)]);
      }
      const int i =
          sameRange(*reference.surface, reference.T_map_sensor.inverse() * p, window, reach);
      if (i < 0) continue;
      ranged.points.push_back(p);
      ranged.partners.push_back(reference.T_map_sensor *
                                reference.surface->points[static_cast<std::size_t>(i)].position);
    }
    if (nearest.points.size() < 3 || ranged.points.size() < 3) break;
    const double turn = ranged.turn();
    const auto [mean, to] = nearest.means();
    const Eigen::Rotation2Dd R(turn);
    const Eigen::Vector2d shift = to - R * mean;
    const Pose2 next{(R * pose.position() + shift).x(), (R * pose.position() + shift).y(),
                     wrapAngle(pose.theta + turn)};
    const double moved = difference(next, pose).cwiseAbs().maxCoeff();
    pose = next;
    if (moved < kSettled) break;
  }
  return judged(query, pose, prior, references);
}

MatchResult matchWeighted(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                          const std::vector<PlacedSurface>& references, double reach) {
  const Returns returns(references);
  const PointIndex index(returns.positions);
  Pose2 pose = start;
  std::vector<std::size_t> found;
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (const ScanSurface::Point& point : query.points) {
      const Eigen::Vector2d p = pose * point.position;
      const int partner = nearestTwo(returns, index, p, reach, found).first;
      if (partner < 0) continue;
      const auto k = static_cast<std::size_t>(partner);
      const Eigen::Matrix2d weight =
          (returns.covariances[k] + Returns::noise(point, pose.theta, query)).inverse();
      const Eigen::Matrix<double, 2, 3> J = jacobian(pose, p);
      H += J.transpose() * weight * J;
      g += J.transpose() * weight * (p - returns.positions[k]);
    }
    hold(prior, pose, H, g);
    if (stepBy(H, g, pose)) break;
  }
  return judged(query, pose, prior, references);
}

MatchResult matchPointToLine(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                             const std::vector<PlacedSurface>& references, double reach) {
  const Returns returns(references);
  const PointIndex index(returns.positions);
  Pose2 pose = start;
  std::vector<std::size_t> found;
  struct Pair {
    double off;  // m, from the line
    Eigen::Vector3d J;
  };
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<Pair> pairs;
    for (const ScanSurface::Point& point : query.points) {
      const Eigen::Vector2d p = pose * point.position;
      const auto [first, second] = nearestTwo(returns, index, p, reach, found);
      if (second < 0) continue;
      const Eigen::Vector2d& a = returns.positions[static_cast<std::size_t>(first)];
      const Eigen::Vector2d along = returns.positions[static_cast<std::size_t>(second)] - a;
      if (along.isZero()) continue;
      const Eigen::Vector2d normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
      pairs.push_back({normal.dot(p - a), jacobian(pose, p).transpose() * normal});
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
      return std::abs(a.off) < std::abs(b.off);
    });
    pairs.resize(static_cast<std::size_t>(kKept * static_cast<double>(pairs.size())));
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    const double weight = 1.0 / std::pow(std::max(query.range_sigma, 1e-3), 2);
    for (const Pair& pair : pairs) {
      H += weight * pair.J * pair.J.transpose();
      g += weight * pair.off * pair.J;
    }
    hold(prior, pose, H, g);
    if (stepBy(H, g, pose)) break;
  }
  return judged(query, pose, prior, references);
}

const std::vector<ScanMatcher>& scanMatchers() {
  static const std::vector<ScanMatcher> all{
      {"line-slam", "ours: point to CCA line, robust", matchSurface},
      {"pl-icp", "Censi 2008", matchPointToLine},
      {"idc", "Lu and Milios 1997, the paper's [6]", matchByDualCorrespondence},
      {"weighted", "Pfister et al. 2002, the paper's [9]", matchWeighted},
  };
  return all;
}

}  // namespace cca::peers
