// SPDX-License-Identifier: BSD-3-Clause
#include "slam/external_corrections.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"

namespace cca {
namespace {

// Of map -> odom, between two scans: more than localisations correct at a step, and than wheels
// err on the way between the two.
constexpr double kLeap = 0.1, kLeapTurn = 0.035, kWheels = 0.1;  // m, rad, of the way
constexpr double kTurnWay = 0.3;                                 // m/rad: wheels turn for that, too
/// m, rad: a correction by less moves no wall by more than its noise.
constexpr double kWorthCorrecting = 0.02, kWorthCorrectingTurn = 0.01;
constexpr double kSameTime = 0.05;  // s, of a pose and a scan
// Returns, of the 90 that a scan is compared by: wheels that slipped by a tenth of a radian come to
// 13, a localisation that was wrong by a metre to 65 and more.
constexpr int kMoreReturns = 30;
constexpr std::size_t kMostCompared = 150;  // scans, spread over the past: bounds the cost

/// So much of a motion, in [0, 1].
Pose2 part(const Pose2& T, double share) { return {share * T.x, share * T.y, share * T.theta}; }

/// Between two motions, so much of the way from a to b, as a robot at `at` sees it.
Pose2 between(const Pose2& a, const Pose2& b, double share, const Pose2& at) {
  const Pose2 from = a * at, to = b * at;
  return from * part(from.inverse() * to, share) * at.inverse();
}

double wayOf(const Pose2& step) { return step.position().norm() + kTurnWay * std::abs(step.theta); }

}  // namespace

Estimate ExternalCorrections::update(const Measurement& measurement, const AnalysedScan& analysed,
                                     const PastScans& past) {
  Estimate estimate;
  estimate.is_known = measurement.T_map_robot.has_value();
  if (estimate.is_known) {
    estimate.T_map_robot = *measurement.T_map_robot;
    estimate.T_map_sensor = analysed.scan.T_map_sensor;
  }
  const Pose2 T_map_odom_before = steps_.empty() ? Pose2{} : steps_.back().T_map_odom;
  const Pose2 T_odom_robot =
      measurement.T_odom_robot.value_or(T_map_odom_before.inverse() * estimate.T_map_robot);
  Step now{measurement.time, 0.0, T_odom_robot, T_map_odom_before};
  if (estimate.is_known) now.T_map_odom = estimate.T_map_robot * T_odom_robot.inverse();
  if (!steps_.empty()) {
    now.way = steps_.back().way + wayOf(steps_.back().T_odom_robot.inverse() * T_odom_robot);
    const bool has_leapt = hasLeapt(now);
    if (is_told_ ? is_path_new_ || has_leapt : has_leapt) {
      const auto corrected = is_told_ ? afterPath(now) : afterLeap(now, analysed.scan, past);
      estimate.was_corrected = corrected.has_value();
      for (std::size_t k = 0; corrected && k < steps_.size(); ++k) {
        steps_[k].T_map_odom = (*corrected)[k];
      }
    }
    if (has_leapt && (is_told_ || estimate.was_corrected)) last_leap_ = steps_.size();
    is_path_new_ = false;
  }
  steps_.push_back(now);
  is_localised_.push_back(estimate.is_known);
  return estimate;
}

std::vector<Pose2> ExternalCorrections::trajectory() const {
  std::vector<Pose2> T_map_robot;
  for (const Step& step : steps_) T_map_robot.push_back(step.T_map_odom * step.T_odom_robot);
  return T_map_robot;
}

std::vector<bool> ExternalCorrections::isLocalised() const { return is_localised_; }

void ExternalCorrections::correct(std::vector<TimedPose> path) {
  path.erase(std::remove_if(path.begin(), path.end(),
                            [](const TimedPose& pose) {
                              const Pose2& T = pose.T_map_robot;
                              return !std::isfinite(pose.time + T.x + T.y + T.theta);
                            }),
             path.end());
  path_ = std::move(path);
  is_told_ = is_path_new_ = true;
}

bool ExternalCorrections::hasLeapt(const Step& now) const {
  const Step& before = steps_.back();
  const Pose2 expected = before.T_map_odom * now.T_odom_robot;
  const Pose2 off = expected.inverse() * (now.T_map_odom * now.T_odom_robot);
  const double by_wheels = kWheels * (now.way - before.way);
  return off.position().norm() > kLeap + by_wheels || std::abs(off.theta) > kLeapTurn + by_wheels;
}

/// The leap, from nothing at the step `since` to all of it now; of what lies before, all or none.
ExternalCorrections::Odometries ExternalCorrections::spread(const Step& now, std::size_t since,
                                                            bool moves_all) const {
  const Pose2 T_now_was = now.T_map_odom * steps_.back().T_map_odom.inverse();
  const double begin = steps_[since].way, length = now.way - begin;
  Odometries T_map_odom;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    double share = k < since ? 0.0 : length > 0.0 ? (step.way - begin) / length : 1.0;
    if (moves_all) share = 1.0;
    T_map_odom.push_back(
        between(step.T_map_odom, T_now_was * step.T_map_odom, share, step.T_odom_robot));
  }
  return T_map_odom;
}

/// Nothing where the past is right as it is: wheels that slipped look like a localisation that was
/// corrected, and only the scans tell the two apart.
std::optional<ExternalCorrections::Odometries> ExternalCorrections::afterLeap(
    const Step& now, const Scan& scan, const PastScans& past) const {
  std::vector<Odometries> candidates{spread(now, 0, false)};
  if (last_leap_ > 0 && last_leap_ < steps_.size()) {
    candidates.push_back(spread(now, last_leap_, false));
  }
  candidates.push_back(spread(now, 0, true));
  Odometries as_it_is;
  for (const Step& step : steps_) as_it_is.push_back(step.T_map_odom);
  int most = agreement(as_it_is, scan, past) + kMoreReturns;
  std::optional<Odometries> best;
  for (Odometries& candidate : candidates) {
    const int agreed = agreement(candidate, scan, past);
    if (agreed <= most) continue;
    most = agreed;
    best = std::move(candidate);
  }
  return best;
}

std::optional<ExternalCorrections::Odometries> ExternalCorrections::afterPath(
    const Step& now) const {
  std::vector<std::pair<double, Pose2>> known;  // T_map_odom at a time
  for (const TimedPose& pose : path_) {
    const auto after = std::lower_bound(
        steps_.begin(), steps_.end(), pose.time,
        [](const Step& step, double time) { return step.time < time - kSameTime; });
    if (after == steps_.end() || after->time > pose.time + kSameTime) continue;
    if (!known.empty() && after->time <= known.back().first) continue;
    known.emplace_back(after->time, pose.T_map_robot * after->T_odom_robot.inverse());
  }
  if (known.empty()) return std::nullopt;
  known.emplace_back(now.time, now.T_map_odom);
  Odometries T_map_odom;
  bool is_worth_it = false;
  std::size_t next = 0;
  for (const Step& step : steps_) {
    while (next + 1 < known.size() && known[next].first < step.time) ++next;
    const auto& [to, T_to] = known[next];
    Pose2 T = T_to;
    if (next > 0 && step.time < to) {
      const auto& [from, T_from] = known[next - 1];
      T = between(T_from, T_to, (step.time - from) / (to - from), step.T_odom_robot);
    }
    const Pose2 off = (step.T_map_odom * step.T_odom_robot).inverse() * (T * step.T_odom_robot);
    is_worth_it = is_worth_it || off.position().norm() > kWorthCorrecting ||
                  std::abs(off.theta) > kWorthCorrectingTurn;
    T_map_odom.push_back(T);
  }
  if (!is_worth_it) return std::nullopt;
  return T_map_odom;
}

/// Returns of the scan just taken that lie on a wall of the line map that those kept make, less the
/// returns of all scans from behind a wall of those before. What the scans kept confirm is no
/// evidence: each finds again what its neighbours saw, however the whole is bent.
int ExternalCorrections::agreement(const Odometries& T_map_odom, const Scan& scan,
                                   const PastScans& past) const {
  const auto& kept = past.kept();
  const std::size_t every = 1 + kept.size() / kMostCompared;
  LineMap map(mapping_);
  int contradicted = 0;
  for (std::size_t k = 0; k < kept.size(); k += every) {
    Scan placed = kept[k].seen.scan;
    const Pose2 T_robot_sensor = kept[k].T_map_robot.inverse() * placed.T_map_sensor;
    const std::size_t step = kept[k].step;
    placed.T_map_sensor = T_map_odom[step] * steps_[step].T_odom_robot * T_robot_sensor;
    contradicted += compareWithMap(placed, map.walls()).contradicted;
    map.insert(placed, kept[k].seen.lines);
  }
  const ScanVerdict verdict = compareWithMap(scan, map.walls());
  return verdict.confirmed - verdict.contradicted - contradicted;
}

}  // namespace cca
