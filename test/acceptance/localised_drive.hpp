// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/known_map/known_map.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/simulation/laser_models.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "cca_mrpt/slam/slam.hpp"
#include "io/lines/line_formats.hpp"
#include "sensing/motion_compensation.hpp"

namespace cca::test {

/// What a localiser is given of a drive, and where the robot was.
struct Drive {
  std::vector<Measurement> measurements;
  std::vector<Pose2> truth;  ///< T_map_robot

  double wayBetween(std::size_t a, std::size_t b) const {
    double way = 0.0;
    for (std::size_t k = a + 1; k <= b; ++k) {
      way += (truth[k].position() - truth[k - 1].position()).norm();
    }
    return way;
  }
  /// The same robot, carried from scan `from` to scan `to` while nobody looked.
  Drive carried(std::size_t from, std::size_t to) const {
    Drive drive;
    const Pose2 jump = *measurements[from].T_odom_robot * measurements[to].T_odom_robot->inverse();
    for (std::size_t k = 0; k <= from; ++k) drive.take(*this, k, {});
    for (std::size_t k = to; k < truth.size(); ++k) drive.take(*this, k, jump);
    return drive;
  }
  Drive part(std::size_t from, std::size_t to) const {
    Drive drive;
    for (std::size_t k = from; k < to; ++k) drive.take(*this, k, {});
    return drive;
  }

 private:
  void take(const Drive& other, std::size_t k, const Pose2& T_odom_other) {
    measurements.push_back(other.measurements[k]);
    measurements.back().T_odom_robot = T_odom_other * *measurements.back().T_odom_robot;
    truth.push_back(other.truth[k]);
  }
};

/// An exploration of a world by a real laser, with wheels that err; the way is that of an explorer
/// that knows its pose.
inline Drive explorationOf(const World& world, const Pose2& start, const std::string& laser,
                           double seconds, std::uint64_t seed = 1) {
  const Parameters parameters;
  SimulationParameters simulated;
  Simulation guide(world, start, simulated);
  Explorer explorer(parameters.robot, parameters.exploration);
  const LaserModel& model = laserModel(laser);
  simulated.laser = model.laser;
  simulated.seed = seed;
  Simulation robot(world, start, simulated);
  const double period = parameters.run.control_period;
  const int every = std::max(1, static_cast<int>(std::lround(1.0 / model.rate / period)));
  MissingReturns missing_returns;
  MotionCompensation compensation(model.laser.sweep);
  Drive drive;
  for (int k = 0; guide.time() < seconds; ++k) {
    const Action action = explorer.step(guide.observe());
    if (action.status == ExplorationStatus::kFinished) break;
    guide.drive(action.velocity, period);
    robot.drive(action.velocity, period);
    if (k % every != 0) continue;
    Measurement measurement;
    measurement.scan = robot.observe().scan;
    missing_returns.judge(measurement.scan);
    measurement.scan = compensation.undistort(measurement.scan, robot.sweepMotion());
    measurement.undone = compensation.undone();
    const Instant& scanned = robot.scanned();
    measurement.T_odom_robot = scanned.T_odom_robot;
    measurement.time = scanned.time;
    drive.measurements.push_back(measurement);
    drive.truth.push_back(scanned.T_map_robot);
  }
  return drive;
}

inline std::vector<PlanLine> planOf(const std::vector<MapLine>& lines) {
  std::vector<PlanLine> plan;
  for (const MapLine& line : lines) plan.emplace_back(line.segment.start, line.segment.end);
  return plan;
}

inline std::vector<PlanLine> trueLines(const std::string& world) {
  const std::string path = std::string(CCA_MAPS_FOLDER) + "/" + world + ".truth.csv";
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return planOf(readLinesCsv(text.str(), path));
}

/// Without what stands free and is small, as furniture does: chains of lines that end in one
/// another's ends, of less than `size` [m] across.
inline std::vector<PlanLine> unfurnished(const std::vector<PlanLine>& lines, double size = 2.6) {
  std::vector<std::size_t> chain(lines.size());
  std::iota(chain.begin(), chain.end(), 0);
  const auto touch = [&](const PlanLine& a, const PlanLine& b) {
    const auto near = [](const auto& p, const auto& q) { return (p - q).norm() < 0.01; };
    return near(a.first, b.first) || near(a.first, b.second) || near(a.second, b.first) ||
           near(a.second, b.second);
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (chain[i] == chain[j] || !touch(lines[i], lines[j])) continue;
      const std::size_t from = chain[i], to = chain[j];
      std::replace(chain.begin(), chain.end(), from, to);
    }
  }
  std::vector<Eigen::AlignedBox2d> boxes(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    boxes[chain[i]].extend(lines[i].first).extend(lines[i].second);
  }
  std::vector<PlanLine> plan;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (boxes[chain[i]].sizes().maxCoeff() > size) plan.push_back(lines[i]);
  }
  return plan;
}

struct Errors {
  double rms = 0.0, worst = 0.0;  ///< m, where localised
  double nees = 0.0;              ///< mean of e' P^-1 e, 3 where the covariance is honest
  Eigen::Vector3d mean_sq = Eigen::Vector3d::Zero();   ///< of e: m^2, m^2, rad^2
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  ///< as the localiser has it
  double within = 0.0;  ///< share of scans with e' P^-1 e below 11.3 (99 % of chi^2(3))
  int scans = 0, unknown = 0;
  int lost = 0;
};

/// @param start  told to the localiser; nothing: it may be anywhere.
inline Errors errorsOf(const Drive& drive, KnownMap& localiser,
                       const std::optional<Pose2>& start = {}) {
  Errors errors;
  if (start) localiser.place(*start, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal());
  for (std::size_t k = 0; k < drive.truth.size(); ++k) {
    const Estimate estimate = localiser.localise(drive.measurements[k]);
    if (!estimate.is_known) {
      ++errors.unknown;
      continue;
    }
    const Pose2 &is = estimate.T_map_robot, &was = drive.truth[k];
    const Eigen::Vector3d e{is.x - was.x, is.y - was.y, wrapAngle(is.theta - was.theta)};
    const double nees = e.dot(estimate.covariance.inverse() * e);
    const double off = e.head<2>().norm();
    errors.rms += off * off;
    errors.worst = std::max(errors.worst, off);
    errors.nees += nees;
    errors.mean_sq += e.cwiseAbs2();
    errors.variance += estimate.covariance.diagonal();
    errors.within += nees < 11.345;
    ++errors.scans;
  }
  errors.lost = localiser.timesLost();
  if (errors.scans == 0) return errors;
  errors.rms = std::sqrt(errors.rms / errors.scans);
  errors.nees /= errors.scans;
  errors.mean_sq /= errors.scans;
  errors.variance /= errors.scans;
  errors.within /= errors.scans;
  return errors;
}

inline bool isRight(const Pose2& believed, const Pose2& truth) {
  return (believed.position() - truth.position()).norm() < 0.3 &&
         std::abs(wrapAngle(believed.theta - truth.theta)) < 0.1;
}

/// How robots that may be anywhere fare.
struct Starts {
  int all = 0;
  int right_at_once = 0, wrong_at_once = 0;  ///< by the first scan
  int right = 0, wrong = 0;                  ///< within three metres
};

/// @param count  starts, spread over the drive.
inline Starts startsOn(const Drive& drive, const std::vector<PlanLine>& plan, int count) {
  const LocalisationEffort at_once{std::numeric_limits<int>::max(),
                                   std::numeric_limits<int>::max()};
  Starts starts;
  for (int k = 0; k < count; ++k) {
    const auto first = static_cast<std::size_t>((k + 0.5) * 0.95 / count *
                                                static_cast<double>(drive.truth.size()));
    KnownMap localiser(plan, {}, at_once);
    ++starts.all;
    for (std::size_t i = first; i < drive.truth.size() && drive.wayBetween(first, i) <= 3.0; ++i) {
      const Estimate estimate = localiser.localise(drive.measurements[i]);
      if (!estimate.is_known) continue;
      const bool is_right = isRight(estimate.T_map_robot, drive.truth[i]);
      if (i == first) ++(is_right ? starts.right_at_once : starts.wrong_at_once);
      ++(is_right ? starts.right : starts.wrong);
      if (!is_right) {
        std::printf("  wrong: start %d is at %.2f, %.2f, believed at %.2f, %.2f\n", k,
                    drive.truth[i].x, drive.truth[i].y, estimate.T_map_robot.x,
                    estimate.T_map_robot.y);
      }
      break;
    }
  }
  return starts;
}

/// How robots fare that are carried elsewhere.
struct Kidnaps {
  int all = 0, noticed = 0, found = 0, wrong = 0;
  double worst_notice = 0.0, worst_find = 0.0;  ///< m, of way since
  double mean_notice = 0.0, mean_find = 0.0;
};

inline Kidnaps kidnapsOn(const Drive& drive, const std::vector<PlanLine>& plan, int count) {
  Kidnaps kidnaps;
  const std::size_t scans = drive.truth.size();
  for (int k = 0; k < count; ++k) {
    const std::size_t from = scans / 10 + static_cast<std::size_t>(k) * scans / (4 * count);
    const std::size_t to = scans / 2 + static_cast<std::size_t>(k) * scans / (4 * count);
    if ((drive.truth[from].position() - drive.truth[to].position()).norm() < 2.0) continue;
    const Drive carried = drive.carried(from, to);
    const std::size_t begin = from > 60 ? from - 60 : 0;
    KnownMap localiser(plan);
    localiser.place(drive.truth[begin], Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal());
    ++kidnaps.all;
    double noticed = -1.0, found = -1.0, way = 0.0;
    for (std::size_t i = begin; i < carried.truth.size(); ++i) {
      const Estimate estimate = localiser.localise(carried.measurements[i]);
      if (i <= from) continue;
      if (i > from + 1) {
        way += (carried.truth[i].position() - carried.truth[i - 1].position()).norm();
      }
      const bool is_right = isRight(estimate.T_map_robot, carried.truth[i]);
      if (noticed < 0.0 && (!estimate.is_known || is_right)) noticed = way;
      if (noticed >= 0.0 && estimate.is_known) {
        if (is_right) found = way;
        if (!is_right) {
          ++kidnaps.wrong;
          std::printf(
              "  wrong: carried from %.1f, %.1f to %.1f, %.1f, after %.1f m believed at "
              "%.2f, %.2f, is at %.2f, %.2f\n",
              carried.truth[from].x, carried.truth[from].y, carried.truth[from + 1].x,
              carried.truth[from + 1].y, way, estimate.T_map_robot.x, estimate.T_map_robot.y,
              carried.truth[i].x, carried.truth[i].y);
        }
        break;
      }
      if (way > 12.0) break;
    }
    if (noticed >= 0.0) {
      ++kidnaps.noticed;
      kidnaps.worst_notice = std::max(kidnaps.worst_notice, noticed);
      kidnaps.mean_notice += noticed;
    }
    if (found >= 0.0) {
      ++kidnaps.found;
      kidnaps.worst_find = std::max(kidnaps.worst_find, found);
      kidnaps.mean_find += found;
    }
  }
  kidnaps.mean_notice /= std::max(1, kidnaps.noticed);
  kidnaps.mean_find /= std::max(1, kidnaps.found);
  return kidnaps;
}

/// T_truth_map, by which poses of a map lie next to the true ones: least squares.
inline Pose2 bestFit(const std::vector<Pose2>& poses, const std::vector<Pose2>& truth) {
  Eigen::Vector2d mean(0, 0), true_mean(0, 0);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    mean += poses[k].position() / static_cast<double>(poses.size());
    true_mean += truth[k].position() / static_cast<double>(poses.size());
  }
  double along = 0.0, across = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Eigen::Vector2d a = poses[k].position() - mean, b = truth[k].position() - true_mean;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 turn{0.0, 0.0, std::atan2(across, along)};
  const Eigen::Vector2d shift = true_mean - turn * mean;
  return {shift.x(), shift.y(), turn.theta};
}

/// The map that a first drive has made, its poses by line SLAM, in the frame of the truth: where a
/// map begins, and how it is turned, is anybody's choice.
struct OwnMap {
  std::vector<PlanLine> lines;
  double rms = 0.0;  ///< m, of its own poses
};

inline OwnMap ownMapOf(const Drive& drive) {
  Slam slam(drive.truth.front());
  for (const Measurement& m : drive.measurements) {
    slam.step(m.scan, m.T_robot_sensor, m.T_odom_robot);
  }
  slam.finish();
  const std::vector<Pose2> poses = slam.trajectory();
  const Pose2 T_truth_map = bestFit(poses, drive.truth);
  LineMap map;
  OwnMap own;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose2 pose = T_truth_map * poses[k];
    own.rms += (pose.position() - drive.truth[k].position()).squaredNorm();
    Scan scan = drive.measurements[k].scan;
    scan.T_map_sensor = pose * drive.measurements[k].T_robot_sensor;
    map.insert(scan);
  }
  own.lines = planOf(map.lines());
  own.rms = std::sqrt(own.rms / static_cast<double>(poses.size()));
  return own;
}

}  // namespace cca::test
