// SPDX-License-Identifier: BSD-3-Clause
#include "slam/sweep_matching.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace cca {
namespace {

/// Each round the scan is bent by what the one before has found: one leaves half of the error, two
/// as little as five. In the third it is known whether the velocity changed.
constexpr int kRounds = 3;
/// Degrees of freedom of the change of velocity within a sweep: Cauchy's. A robot mostly keeps its
/// velocity, and at times changes it much.
constexpr double kChangeFreedom = 1.0;
/// Of the wheels' information: what keeps a change that the scan shows nothing of from running off.
constexpr double kVagueChange = 0.01;

/// Of given poses: as many scans as line SLAM matches with; half a metre of way.
constexpr std::size_t kLastScans = 5;
/// 1/m^2, 1/rad^2: from scan to scan given poses err by some two centimetres and a degree.
constexpr double kGivenPose = 2500.0, kGivenTurn = 3300.0;

SweepShares sharesOf(const ScanSurface& query, double sense) {
  const double last = std::max(1, query.beams() - 1);
  SweepShares shares;
  for (const ScanSurface::Point& point : query.points) {
    const double time = sense * (point.beam / last - 0.5);  // of the sweep, from its middle on
    shares.before.push_back(static_cast<float>(time - 2.0 * time * time));
    shares.after.push_back(static_cast<float>(time + 2.0 * time * time));
  }
  return shares;
}

/// Each point moved by its shares of small motions.
PackedPoints bent(const PackedPoints& points, const SweepShares& shares,
                  const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  PackedPoints moved = points;
  const Eigen::Vector3f b = before.cast<float>(), a = after.cast<float>();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector3f motion = shares.before[k] * b + shares.after[k] * a;
    moved.x[k] += motion.x() - motion.z() * points.y[k];
    moved.y[k] += motion.y() + motion.z() * points.x[k];
  }
  return moved;
}

Pose2 added(const Pose2& motion, const Eigen::Vector3d& step) {
  return {motion.x + step.x(), motion.y + step.y(), motion.theta + step.z()};
}

/// Three of the nine unknowns, or a mixture: the pose, the motions before and after.
using Mixture = Eigen::Matrix<double, 3, 9>;
Mixture part(double pose, double before, double after) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  Mixture mixture;
  mixture << pose * identity, before * identity, after * identity;
  return mixture;
}

/// Adds what is known of a part of the unknowns, which is off by `off` from that.
void hold(const Mixture& part, const Eigen::Matrix3d& information, const Eigen::Vector3d& off,
          SweepQuadric& quadric) {
  quadric.H += part.transpose() * information * part;
  quadric.g += part.transpose() * information * off;
}

/// By all that it holds, the information on a part of the unknowns.
Eigen::Matrix3d informationOn(const Mixture& part, const SweepQuadric& quadric) {
  return (part * quadric.H.inverse() * part.transpose()).inverse();
}

/// Compares the change that the wheels tell with the one that the scan shows by itself.
/// @param now    the change so far, in the axes of the map as all that follows.
/// @param known  the information of the wheels.
void compareChange(const Mixture& change, const SweepQuadric& by_scan, const Eigen::Vector3d& now,
                   const Eigen::Vector3d& by_wheels, const Eigen::Matrix3d& known, SweepFit& fit) {
  const Eigen::Vector3d seen = now - change * by_scan.H.ldlt().solve(by_scan.g);
  const Eigen::Matrix3d weight = informationOn(change, by_scan);
  fit.change_error = by_wheels.dot(weight * (by_wheels - seen));
  fit.expected_change_error = (weight * known.inverse()).trace();
}

}  // namespace

std::optional<SweepFit> matchSweep(const ScanSurface& query, const SweptScan& sweep,
                                   const Pose2& start, const PoseBelief& prior,
                                   const SweepBelief& belief,
                                   const std::vector<PlacedSurface>& references) {
  const Mixture pose = part(1.0, 0.0, 0.0), sum = part(0.0, 1.0, 1.0),
                change = part(0.0, -1.0, 1.0);
  const SweepShares shares = sharesOf(query, sweep.sense);
  const MatchScale scale = finestScale(query);
  const double noise = noiseShare(query, scale);
  // As in matchSurface(): Student's t, for wheels slip now and then.
  const Eigen::Vector3d off = difference(start, prior.mean);
  const Eigen::Matrix3d held =
      prior.information / (1.0 + off.dot(prior.information * off) / kPriorFreedom);
  // Beyond what was undone, in the sensor's axes.
  const Eigen::Vector3d undone_change = difference(sweep.motion.after, sweep.motion.before);
  const Eigen::Vector3d by_wheels = difference(belief.motion.after, belief.motion.before);
  Eigen::Vector3d before = difference(belief.motion.before, sweep.motion.before);
  Eigen::Vector3d after = difference(belief.motion.after, sweep.motion.after);
  const Eigen::Vector3d expected_sum = before + after;
  Pose2 T_map_query = start;
  SweepFit fit;
  for (int round = 0; round < kRounds; ++round) {
    SweepQuadric quadric = sweepQuadric(bent(query.packed, shares, before, after), shares,
                                        T_map_query, references, scale);
    if (2 * quadric.paired < static_cast<int>(query.points.size()) || quadric.paired == 0)
      return std::nullopt;
    quadric.H /= noise * noise;
    quadric.g /= noise * noise;
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // sensor to map
    R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_map_query.theta).toRotationMatrix();
    // The halves err by themselves: their sum and their change do, by twice as much.
    const Eigen::Matrix3d known = 0.5 * R * belief.information * R.transpose();
    const Eigen::Vector3d now = R * (undone_change + after - before);
    hold(pose, held, difference(T_map_query, prior.mean), quadric);
    hold(sum, known, R * (before + after - expected_sum), quadric);
    SweepQuadric by_scan = quadric;
    hold(change, kVagueChange * known, now, by_scan);
    hold(change, known / belief.change_share, now - R * by_wheels, quadric);
    if (round > 0) {
      const Eigen::Matrix3d told = informationOn(change, quadric);
      hold(change, told * (kChangeFreedom + 3.0) / (kChangeFreedom + now.dot(told * now)), now,
           quadric);
    }
    const Eigen::LDLT<decltype(quadric.H)> solver(quadric.H);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
    const auto step = solver.solve(-quadric.g).eval();
    if (!step.allFinite()) return std::nullopt;
    T_map_query.x += step(0);
    T_map_query.y += step(1);
    T_map_query.theta = wrapAngle(T_map_query.theta + step(2));
    before += R.transpose() * step.segment<3>(3);
    after += R.transpose() * step.segment<3>(6);
    if (round + 1 < kRounds) continue;
    compareChange(change, by_scan, now, R * by_wheels, known, fit);
  }
  fit.motion = {added(sweep.motion.before, before), added(sweep.motion.after, after)};
  return fit;
}

void bendBy(const SweepHalves& motion, const SweptScan& sweep, ScanSurface& surface) {
  const Eigen::Vector3d before = difference(motion.before, sweep.motion.before);
  const Eigen::Vector3d after = difference(motion.after, sweep.motion.after);
  const PackedPoints moved = bent(surface.packed, sharesOf(surface, sweep.sense), before, after);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    surface.points[k].position = {moved.x[k], moved.y[k]};
  }
  surface.pack();
}

SweepBelief sweepBelief(const SweepHalves& undone_by, const MotionPrior& prior, bool by_wheels) {
  const auto& [before, after] = undone_by;
  const Pose2 whole = added(before, {after.x, after.y, after.theta});
  MotionBelief belief = prior.predict(by_wheels ? std::optional(whole) : std::nullopt);
  if (!by_wheels) belief.T_before_after = whole;
  const Eigen::Vector3d half = 0.5 * difference(belief.T_before_after, whole);
  // Each half errs by itself: by half of the variance.
  return {{added(before, half), added(after, half)},
          2.0 * belief.covariance.inverse(),
          prior.changeShare()};
}

std::optional<SweepHalves> matchSweep(const AnalysedScan& analysed, const SweptScan& sweep,
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
  const auto fit = matchSweep(scanSurface(analysed), sweep, T_map_sensor, prior,
                              sweepBelief(sweep.motion, MotionPrior(), true), references);
  return fit ? std::optional(fit->motion) : std::nullopt;
}

}  // namespace cca
