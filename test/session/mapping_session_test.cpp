// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/mapping_session.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <random>

#include "../navigation/known_world.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "counting_recorder.hpp"

namespace cca {
namespace {

/// A corridor around a block, 0.5 m a letter.
const KnownWorld kAround{
    {"##############", "#............#", "#............#", "#...######...#", "#...######...#",
     "#...######...#", "#............#", "#............#", "##############"},
    10};

/// Two scans of one place, every 4 cm of a way along one side; the wheels turn a little too far.
std::vector<Measurement> drive() {
  std::vector<Measurement> measurements;
  Pose2 T_odom_robot{1.0, 1.0, 0.0};
  std::mt19937 random(3);
  for (int k = 0; k < 200; ++k) {
    const Pose2 truth{1.0 + 0.02 * k, 1.0 + 0.001 * k, 0.3 * std::sin(0.05 * k)};
    Measurement measurement;
    measurement.scan = kAround.scanFrom(truth, 6.0);
    for (double& range : measurement.scan.ranges) {
      range += 0.01 * (static_cast<double>(random() % 1000) / 1000.0 - 0.5);
    }
    measurement.scan.T_map_sensor = truth;
    if (k > 0) {
      Pose2 step = measurements.back().T_map_robot->inverse() * truth;
      step.theta *= 1.05;
      T_odom_robot = T_odom_robot * step;
    }
    measurement.T_odom_robot = T_odom_robot;
    measurement.T_map_robot = truth;
    measurement.time = 0.1 * k;
    measurements.push_back(measurement);
  }
  return measurements;
}

std::vector<double> numbersOf(const LineMap& map) {
  std::vector<double> numbers;
  for (const MapLine& line : map.lines()) {
    for (const Eigen::Vector2d& end : {line.segment.start, line.segment.end}) {
      numbers.push_back(end.x());
      numbers.push_back(end.y());
    }
  }
  return numbers;
}

/// Believes given poses, all of them moved by half a metre once a scan is the one to correct at;
/// the robot is lost for the scans before `found`.
class MovingPoses : public Localiser {
 public:
  MovingPoses(int corrected_at, int found) : corrected_at_(corrected_at), found_(found) {}
  Estimate update(const Measurement& measurement, const AnalysedScan& /*analysed*/,
                  const PastScans& /*past*/) override {
    told_.push_back(*measurement.T_map_robot);
    const int k = static_cast<int>(told_.size()) - 1;
    Estimate estimate;
    estimate.was_corrected = k == corrected_at_;
    estimate.is_known = k >= found_;
    if (k >= corrected_at_) is_moved_ = true;
    estimate.T_map_robot = trajectory().back();
    estimate.T_map_sensor = estimate.T_map_robot;
    return estimate;
  }
  bool correctsPast() const override { return true; }
  std::vector<Pose2> trajectory() const override {
    std::vector<Pose2> poses;
    for (const Pose2& pose : told_) {
      poses.push_back(is_moved_ ? Pose2{0.5, 0.0, 0.0} * pose : pose);
    }
    return poses;
  }
  std::vector<bool> isLocalised() const override { return std::vector<bool>(told_.size(), true); }

 private:
  int corrected_at_, found_;
  bool is_moved_ = false;
  std::vector<Pose2> told_;
};

LineMap mapOf(MappingSession& session) {
  for (const Measurement& measurement : drive()) session.add(measurement);
  session.finish();
  return session.lineMap();
}

TEST(MappingSession, BeamsPointNoSurerThanTheHeadingIsKnown) {
  MappingSession by_slam(std::make_unique<SlamLocaliser>(), {});
  MappingSession given(std::make_unique<GivenPoses>(), {});
  int less_sure = 0;
  for (const Measurement& measurement : drive()) {
    const Estimate estimate = by_slam.add(measurement);
    const double heading_sigma = std::sqrt(estimate.covariance(2, 2));
    ASSERT_GE(by_slam.scan().bearing_sigma, heading_sigma);
    less_sure += heading_sigma > 0.0;
    given.add(measurement);
    ASSERT_EQ(given.scan().bearing_sigma, 0.0);
  }
  EXPECT_GT(less_sure, 100);
}

/// Knows the place; the heading is off to one side and the other, and told to be known to `told`.
class UnsureHeading : public Localiser {
 public:
  UnsureHeading(double off, double told) : off_(off), told_(told) {}
  Estimate update(const Measurement& measurement, const AnalysedScan& /*analysed*/,
                  const PastScans& /*past*/) override {
    off_ = -off_;
    Estimate estimate;
    estimate.T_map_robot = *measurement.T_map_robot;
    estimate.T_map_robot.theta += off_;
    estimate.T_map_sensor = estimate.T_map_robot;
    estimate.covariance(2, 2) = told_ * told_;
    return estimate;
  }

 private:
  double off_, told_;
};

/// Cells seen free behind a wall 20 m long, at no line of the grid, that a robot looks along which
/// turns on the spot 0.4 m before it; one beam in 33 is lost.
int freedBehindAWall(double told_sigma) {
  const Pose2 T_map_wall{0.313, -0.287, 0.1};  // the wall is its x axis, the room at y > 0
  MappingSession session(std::make_unique<UnsureHeading>(0.006, told_sigma), {});
  ExplorationGrid grid(0.05);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (int k = 0; k < 40; ++k) {
    const Pose2 T_wall_robot{0.5, 0.4, -0.5 + 0.02 * k};
    Measurement measurement;
    measurement.scan.angle_min = -0.75 * M_PI;
    measurement.scan.angle_increment = M_PI / 720.0;
    for (std::size_t beam = 0; beam < 1081; ++beam) {
      const double bearing = T_wall_robot.theta + measurement.scan.bearing(beam);
      const double x = std::cos(bearing), y = std::sin(bearing);
      const double to_end = x > 0.0 ? 19.5 / x : 0.5 / -x, to_side = y > 0.0 ? 1.6 / y : 0.4 / -y;
      measurement.scan.ranges.push_back(random() % 33 == 0
                                            ? std::numeric_limits<double>::infinity()
                                            : std::min(to_end, to_side) + noise(random));
    }
    measurement.T_map_robot = T_map_wall * T_wall_robot;
    measurement.time = 0.025 * k;
    session.add(measurement);
    grid.insert(session.scan());
  }
  int freed = 0;
  for (int y = grid.lowest().y; y <= grid.highest().y; ++y) {
    for (int x = grid.lowest().x; x <= grid.highest().x; ++x) {
      const Eigen::Vector2d p = T_map_wall.inverse() * grid.centreOf({x, y});
      freed += p.y() < -0.06 && p.x() > 0.1 && p.x() < 19.9 && grid.at({x, y}) == CellState::kFree;
    }
  }
  return freed;
}

TEST(MappingSession, ARobotThatTurnsOpensNoWallFarAway) {
  EXPECT_GT(freedBehindAWall(0.0), 20) << "else nothing is shown";
  EXPECT_EQ(freedBehindAWall(0.004), 0);
}

TEST(MappingSession, MapsEachScanAtGivenPoses) {
  CountingRecorder recorder;
  MappingSession session(std::make_unique<GivenPoses>(), {}, &recorder);
  const LineMap map = mapOf(session);
  LineMap expected;
  for (const Measurement& measurement : drive()) expected.insert(measurement.scan);
  expected.lookBack(session.past().kept());
  EXPECT_EQ(numbersOf(map), numbersOf(expected));
  EXPECT_EQ(recorder.numbers.size(), drive().size());
  EXPECT_EQ(recorder.restarts, 0);
  EXPECT_EQ(session.times().size(), drive().size());
}

TEST(MappingSession, MapsNothingWhereNobodyTellsThePose) {
  MappingSession session(std::make_unique<GivenPoses>(), {});
  Measurement measurement = drive().front();
  measurement.T_map_robot.reset();
  EXPECT_FALSE(session.add(measurement).is_known);
  EXPECT_TRUE(session.lineMap().lines().empty());
  EXPECT_EQ(session.isLocalised(), std::vector<bool>{false});
}

TEST(MappingSession, OneDriveGivesOneMapWheneverItIsMapped) {
  MappingSession online(std::make_unique<SlamLocaliser>(), {});
  MappingSession::Settings late;
  late.maps_at_the_end = true;
  MappingSession at_the_end(std::make_unique<SlamLocaliser>(), late);
  std::deque<std::function<void()>> waiting;
  MappingSession queued(std::make_unique<SlamLocaliser>(), {}, nullptr,
                        [&](std::function<void()> work) { waiting.push_back(std::move(work)); });
  const auto map = numbersOf(mapOf(online));
  EXPECT_GE(map.size(), 4U * 4U);
  EXPECT_EQ(numbersOf(mapOf(at_the_end)), map);
  mapOf(queued);
  for (const auto& work : waiting) work();
  EXPECT_EQ(numbersOf(queued.lineMap()), map);
  EXPECT_EQ(queued.agreement().overall(), online.agreement().overall());
}

TEST(MappingSession, MapsEachScanOnceWhereThePastIsCorrected) {
  CountingRecorder recorder;
  MappingSession session(std::make_unique<MovingPoses>(150, 0), {}, &recorder);
  for (const Measurement& measurement : drive()) session.add(measurement);
  EXPECT_EQ(recorder.restarts, 1);
  EXPECT_TRUE(std::is_sorted(recorder.numbers.begin(), recorder.numbers.end()));
  EXPECT_EQ(std::adjacent_find(recorder.numbers.begin(), recorder.numbers.end()),
            recorder.numbers.end());
  EXPECT_EQ(recorder.numbers.size(), session.past().kept().size());
  EXPECT_NEAR(session.trajectory().front().x, 1.5, 1e-12);
  double leftmost = 1e9;
  for (const MapLine& line : session.lineMap().lines()) {
    leftmost = std::min({leftmost, line.segment.start.x(), line.segment.end.x()});
  }
  EXPECT_NEAR(leftmost, 1.0, 0.03);  // the wall at 0.5 m, moved with all the rest
}

TEST(MappingSession, MapsScansOfALostRobotOnceTheirPlaceIsKnown) {
  CountingRecorder recorder;
  MappingSession session(std::make_unique<MovingPoses>(100, 100), {}, &recorder);
  const std::vector<Measurement> scans = drive();
  for (std::size_t k = 0; k < 100; ++k) session.add(scans[k]);
  EXPECT_TRUE(recorder.numbers.empty());
  session.add(scans[100]);
  EXPECT_EQ(recorder.numbers.front(), 0U);
  EXPECT_EQ(recorder.numbers.size(), session.past().kept().size());
}

TEST(MappingSession, ASecondLaserGoesWithTheFirst) {
  CountingRecorder recorder;
  MappingSession session(std::make_unique<WheelOdometry>(), {}, &recorder);
  Measurement first = drive().front();
  first.T_map_robot = Pose2{3.0, 2.0, 0.5};
  first.T_odom_robot = Pose2{};
  Measurement second = first;
  second.T_map_robot.reset();
  second.T_odom_robot = Pose2{0.1, 0.0, 0.0};
  EXPECT_FALSE(session.addSecondary(second, 1).is_known);  // nobody knows where the robot is yet
  session.add(first);
  const Estimate beside = session.addSecondary(second, 1);
  EXPECT_TRUE(beside.is_known);
  EXPECT_NEAR(beside.T_map_robot.x, 3.0 + 0.1 * std::cos(0.5), 1e-12);
  EXPECT_EQ(recorder.numbers, (std::vector<std::size_t>{0, 0}));
}

}  // namespace
}  // namespace cca
