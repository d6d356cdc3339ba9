// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/past_scans.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace cca {
namespace {

// m, rad, between kept scans. Twice as far apart costs .001 of a map's F (freiburg-079 .002), twice
// as close as much again of memory and of the time to make a map anew.
constexpr double kEveryDistance = 0.1, kEveryTurn = M_PI / 36.0;

/// Whether the robot has moved far enough since the last scan of this sensor that was kept.
bool isDue(const std::vector<PastScans::Kept>& kept, const Pose2& here, std::size_t sensor) {
  const auto last = std::find_if(kept.rbegin(), kept.rend(),
                                 [sensor](const auto& other) { return other.sensor == sensor; });
  if (last == kept.rend()) return true;
  const Pose2& there = last->T_map_robot;
  return !((here.position() - there.position()).norm() < kEveryDistance &&
           std::abs(wrapAngle(here.theta - there.theta)) < kEveryTurn);
}

}  // namespace

bool PastScans::add(const AnalysedScan& seen, const Pose2& T_map_robot, bool is_placed) {
  const std::size_t step = steps_++;
  std::vector<Kept>& kept = is_placed ? kept_ : unplaced_;
  if (!isDue(kept, T_map_robot, 0)) return false;
  kept.push_back({step, seen, T_map_robot, T_map_robot, is_placed});
  return true;
}

bool PastScans::addBeside(std::size_t step, const AnalysedScan& seen, const Pose2& T_map_robot,
                          std::size_t sensor) {
  if (!isDue(kept_, T_map_robot, sensor)) return false;
  kept_.push_back({step, seen, T_map_robot, T_map_robot, true, sensor});
  return true;
}

void PastScans::correct(const std::vector<Pose2>& T_map_robot, const std::vector<bool>& is_placed) {
  assert(T_map_robot.size() >= steps_ && is_placed.size() >= steps_);
  for (Kept& kept : kept_) kept.was_placed = true;
  std::vector<Kept> all;
  std::merge(kept_.begin(), kept_.end(), unplaced_.begin(), unplaced_.end(),
             std::back_inserter(all), [](const Kept& a, const Kept& b) { return a.step < b.step; });
  kept_.clear();
  unplaced_.clear();
  for (Kept& kept : all) {
    const Pose2 T_robot_sensor = kept.T_map_robot.inverse() * kept.seen.scan.T_map_sensor;
    kept.T_was_robot = kept.T_map_robot;
    kept.T_map_robot = T_map_robot[kept.step];
    kept.seen.scan.T_map_sensor = kept.T_map_robot * T_robot_sensor;
    (is_placed[kept.step] ? kept_ : unplaced_).push_back(std::move(kept));
  }
}

Pose2 PastScans::correctionAt(const Eigen::Vector2d& p_was) const {
  double least = std::numeric_limits<double>::infinity();
  Pose2 T_map_was;
  for (const Kept& kept : kept_) {
    const double distance = (kept.T_was_robot.position() - p_was).norm();
    if (!kept.was_placed || distance > least) continue;
    least = distance;
    T_map_was = kept.T_map_robot * kept.T_was_robot.inverse();
  }
  return T_map_was;
}

Pose2 PastScans::correctionHere() const {
  return kept_.empty() ? Pose2{} : kept_.back().T_map_robot * kept_.back().T_was_robot.inverse();
}

}  // namespace cca
