// SPDX-License-Identifier: BSD-3-Clause
#include "slam/external_corrections.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../navigation/known_world.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {
namespace {

/// A corridor around a block, 0.5 m a letter.
const KnownWorld kAround{
    {"##############", "#............#", "#............#", "#...######...#", "#...######...#",
     "#...######...#", "#............#", "#............#", "##############"},
    10};

/// m, of all lines.
double length(const LineMap& map) {
  double sum = 0.0;
  for (const MapLine& line : map.lines()) sum += (line.segment.end - line.segment.start).norm();
  return sum;
}

/// Once around, 5 cm a step.
std::vector<Pose2> onceAround() {
  const std::vector<Eigen::Vector2d> corners{{1.0, 1.0}, {6.0, 1.0}, {6.0, 3.5},
                                             {1.0, 3.5}, {1.0, 1.0}, {3.0, 1.0}};
  std::vector<Pose2> way;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Eigen::Vector2d leg = corners[k] - corners[k - 1];
    const double theta = std::atan2(leg.y(), leg.x());
    const int turns = way.empty() ? 0 : 9;
    for (int i = 1; i <= turns; ++i) {
      const double turn = wrapAngle(theta - way.back().theta) / (turns - i + 1);
      way.push_back({way.back().x, way.back().y, wrapAngle(way.back().theta + turn)});
    }
    const int steps = static_cast<int>(std::lround(leg.norm() / 0.05));
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d p = corners[k - 1] + leg * i / steps;
      way.push_back({p.x(), p.y(), theta});
    }
  }
  return way;
}

/// A line map made of the scans kept, and anew where the past is corrected.
struct Mapper {
  ExternalCorrections corrections{CcaParameters{}};
  PastScans past;
  LineMap map{CcaParameters{}};
  double time = 0.0;
  int corrected = 0;

  void take(const Pose2& T_true, const Pose2& T_map_robot, const Pose2& T_odom_robot) {
    Measurement measurement;
    measurement.scan = kAround.scanFrom(T_true, 6.0);
    measurement.scan.T_map_sensor = T_map_robot;
    measurement.T_map_robot = T_map_robot;
    measurement.T_odom_robot = T_odom_robot;
    measurement.time = time += 0.1;
    if (corrections.update(measurement, {measurement.scan, {}, {}}, past).was_corrected) {
      ++corrected;
      past.correct(corrections.trajectory(), corrections.isLocalised());
      map = LineMap(CcaParameters{});
      for (const auto& kept : past.kept()) map.insert(kept.seen.scan, kept.seen.lines);
    }
    past.add(analyse(measurement.scan), T_map_robot);
    map.insert(measurement.scan);
  }
  double error(const std::vector<Pose2>& truth) const {
    double most = 0.0;
    const auto way = corrections.trajectory();
    for (std::size_t k = 0; k < way.size(); ++k) {
      most = std::max(most, (way[k].position() - truth[k].position()).norm());
    }
    return most;
  }
};

const Pose2 kLeap{1.0, 0.3, 0.1}, kFarLeap{60.0, 0.0, 0.0};

double trueLength() {
  Mapper mapper;
  for (const Pose2& T : onceAround()) mapper.take(T, T, T);
  EXPECT_EQ(mapper.corrected, 0);
  return length(mapper.map);
}

TEST(ExternalCorrections, EveryWallIsThereOnceWhereALocalisationFindsThatItWasElsewhere) {
  const auto truth = onceAround();
  for (const Pose2& leap : {kLeap, kFarLeap}) {
    Mapper mapper;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const bool is_wrong = k < truth.size() * 2 / 3;
      mapper.take(truth[k], is_wrong ? leap * truth[k] : truth[k], truth[k]);
    }
    EXPECT_EQ(mapper.corrected, 1);
    EXPECT_LT(mapper.error(truth), 0.01);
    EXPECT_NEAR(length(mapper.map), trueLength(), 1.0);
  }
}

TEST(ExternalCorrections, ALeapThatGoesBackLeavesThePastAsItWas) {
  const auto truth = onceAround();
  Mapper mapper;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const bool is_wrong = k > 100 && k < 106;
    mapper.take(truth[k], is_wrong ? kLeap * truth[k] : truth[k], truth[k]);
  }
  EXPECT_EQ(mapper.corrected, 2);
  EXPECT_LT(mapper.error(truth), 0.05);
  EXPECT_NEAR(length(mapper.map), trueLength(), 1.0);
}

TEST(ExternalCorrections, WheelsThatSlipLeaveThePastAsItWas) {
  const auto truth = onceAround();
  for (const Pose2& slip : {Pose2{0.0, 0.0, 0.06}, Pose2{0.0, 0.0, -0.3}, Pose2{0.25, 0.0, 0.0}}) {
    for (const std::size_t at : {std::size_t{3}, std::size_t{120}, truth.size() - 40}) {
      Mapper mapper;
      Pose2 T_odom_true;
      for (std::size_t k = 0; k < truth.size(); ++k) {
        if (k == at) T_odom_true = truth[k] * slip * truth[k].inverse();
        mapper.take(truth[k], truth[k], T_odom_true * truth[k]);
      }
      EXPECT_EQ(mapper.corrected, 0) << slip.x << ' ' << slip.theta << ' ' << at;
    }
  }
}

/// Wheels that turn too far, and a SLAM that finds out when it is back.
struct Drifting {
  std::vector<Pose2> truth = onceAround(), odometry{truth.front()};
  std::size_t back = 0;
  Drifting() {
    for (std::size_t k = 1; k < truth.size(); ++k) {
      Pose2 step = truth[k - 1].inverse() * truth[k];
      step.theta += 0.005 * step.position().norm() / 0.25;
      step.x *= 1.02;
      odometry.push_back(odometry.back() * step);
      const bool is_back = (truth[k].position() - truth.front().position()).norm() < 0.1;
      if (k > 50 && back == 0 && is_back) back = k;
    }
  }
  Pose2 told(std::size_t k) const {
    if (k < back) return odometry[k];
    return truth[back] * odometry[back].inverse() * odometry[k];
  }
};

TEST(ExternalCorrections, ALoopThatIsClosedTakesAllTheWayAlong) {
  const Drifting drive;
  Mapper mapper;
  double before = 0.0;
  for (std::size_t k = 0; k < drive.truth.size(); ++k) {
    if (k == drive.back) before = mapper.error(drive.truth);
    mapper.take(drive.truth[k], drive.told(k), drive.odometry[k]);
  }
  EXPECT_EQ(mapper.corrected, 1);
  EXPECT_LT(mapper.error(drive.truth), 0.5 * before) << before;
}

TEST(ExternalCorrections, PosesThatAreToldAsCorrectedAreTaken) {
  const Drifting drive;
  for (const int late : {0, 5, -5}) {  // scans, the path after the leap
    Mapper mapper;
    for (std::size_t k = 0; k < drive.truth.size(); ++k) {
      if (static_cast<int>(k) == static_cast<int>(drive.back) + late) {
        std::vector<ExternalCorrections::TimedPose> path{{-3.0, {}}};  // of no scan
        for (std::size_t j = 0; j < k; j += 4) path.push_back({0.1 * (j + 1), drive.truth[j]});
        mapper.corrections.correct(path);
      }
      mapper.take(drive.truth[k], drive.told(k), drive.odometry[k]);
    }
    EXPECT_LT(mapper.error(drive.truth), 0.1) << late;
    EXPECT_NEAR(length(mapper.map), trueLength(), 2.0) << late;
  }
}

TEST(ExternalCorrections, PathsThatMakeNoSenseChangeNothing) {
  const auto truth = onceAround();
  Mapper mapper;
  for (const Pose2& T : truth) {
    mapper.take(T, T, T);
    mapper.corrections.correct({{NAN, {}}, {0.1, {NAN, 0, 0}}, {-1e9, {}}, {1e300, {}}});
  }
  EXPECT_EQ(mapper.corrected, 0);
  mapper.corrections.correct({});
  mapper.take(truth.back(), truth.back(), truth.back());
  EXPECT_EQ(mapper.corrected, 0);
}

}  // namespace
}  // namespace cca
