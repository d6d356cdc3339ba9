// SPDX-License-Identifier: BSD-3-Clause
#include "slam/sweep_matching.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "slam/motion_prior.hpp"

namespace cca {
namespace {

/// Each round the scan is bent by what the one before has found. Of wheels that err by .23 degrees
/// within a sweep one leaves .11, two .09, five as much.
constexpr int kRounds = 2;

/// Of given poses: as many scans as line SLAM matches with; half a metre of way.
constexpr std::size_t kLastScans = 5;
/// 1/m^2, 1/rad^2: from scan to scan given poses err by some two centimetres and a degree.
constexpr double kGivenPose = 2500.0, kGivenTurn = 3300.0;

/// Of each point of the surface, as a share of the sweep from its middle on.
std::vector<float> timesOf(const ScanSurface& query, double sense) {
  const double last = std::max(1, query.beams() - 1);
  std::vector<float> times;
  times.reserve(query.points.size());
  for (const ScanSurface::Point& point : query.points)
    times.push_back(static_cast<float>(sense * (point.beam / last - 0.5)));
  return times;
}

/// Each point moved by its share of a small motion.
PackedPoints bent(const PackedPoints& points, const std::vector<float>& times,
                  const Eigen::Vector3d& motion) {
  PackedPoints moved = points;
  const auto x = static_cast<float>(motion.x()), y = static_cast<float>(motion.y());
  const auto turn = static_cast<float>(motion.z());
  for (std::size_t k = 0; k < times.size(); ++k) {
    moved.x[k] += times[k] * (x - turn * points.y[k]);
    moved.y[k] += times[k] * (y + turn * points.x[k]);
  }
  return moved;
}

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

}  // namespace

std::optional<Pose2> matchSweep(const ScanSurface& query, double sense, const Pose2& undone_by,
                                const Pose2& start, const PoseBelief& prior,
                                const SweepBelief& belief,
                                const std::vector<PlacedSurface>& references) {
  const std::vector<float> times = timesOf(query, sense);
  const MatchScale scale = finestScale(query);
  const double noise = noiseShare(query, scale);
  const Eigen::Vector3d expected = difference(belief.step, undone_by);  // beyond what was undone
  // As in matchSurface(): Student's t, for wheels slip now and then.
  const Eigen::Vector3d off = difference(start, prior.mean);
  const Eigen::Matrix3d held =
      prior.information / (1.0 + off.dot(prior.information * off) / kPriorFreedom);
  Pose2 T_map_query = start;
  Eigen::Vector3d motion = expected;  // in the sensor's axes
  for (int round = 0; round < kRounds; ++round) {
    const SweepQuadric quadric =
        sweepQuadric(bent(query.packed, times, motion), times, T_map_query, references, scale);
    if (2 * quadric.paired < static_cast<int>(query.points.size()) || quadric.paired == 0)
      return std::nullopt;
    Matrix6d H = quadric.H / (noise * noise);
    Vector6d g = quadric.g / (noise * noise);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // sensor to map
    R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_map_query.theta).toRotationMatrix();
    H.topLeftCorner<3, 3>() += held;
    g.head<3>() += held * difference(T_map_query, prior.mean);
    H.bottomRightCorner<3, 3>() += R * belief.information * R.transpose();
    g.tail<3>() += R * belief.information * (motion - expected);
    const Eigen::LDLT<Matrix6d> solver(H);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
    const Vector6d step = solver.solve(-g);
    if (!step.allFinite()) return std::nullopt;
    T_map_query.x += step(0);
    T_map_query.y += step(1);
    T_map_query.theta = wrapAngle(T_map_query.theta + step(2));
    motion += R.transpose() * step.tail<3>();
  }
  return Pose2{undone_by.x + motion.x(), undone_by.y + motion.y(), undone_by.theta + motion.z()};
}

std::optional<Pose2> matchSweep(const AnalysedScan& analysed, const SweptScan& sweep,
                                const Pose2& T_map_sensor, const PastScans& past) {
  std::vector<const PastScans::Kept*> last;
  for (auto kept = past.kept().rbegin(); kept != past.kept().rend() && last.size() < kLastScans;
       ++kept) {
    if (kept->sensor == 0) last.push_back(&*kept);
  }
  std::vector<ScanSurface> surfaces;
  for (const PastScans::Kept* kept : last) surfaces.push_back(scanSurface(kept->seen));
  std::vector<PlacedSurface> references;
  for (std::size_t k = 0; k < last.size(); ++k)
    references.push_back({&surfaces[k], last[k]->seen.scan.T_map_sensor});
  if (references.empty()) return std::nullopt;
  PoseBelief prior;
  prior.mean = T_map_sensor;
  prior.information.diagonal() << kGivenPose, kGivenPose, kGivenTurn;
  const MotionBelief within = MotionPrior().predict(sweep.motion);
  return matchSweep(scanSurface(analysed), sweep.sense, sweep.motion, T_map_sensor, prior,
                    {within.T_before_after, within.covariance.inverse()}, references);
}

}  // namespace cca
