// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/laser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cca_mrpt/simulation/laser_models.hpp"

namespace cca {
namespace {

/// A free room of 4 x 3 m inside walls one cell (5 cm) thick.
World room() {
  return World("room", 82, 62, std::vector<unsigned char>(82 * 62, 0), 0.05, {-0.05, -0.05});
}

double truthInRoom(const Eigen::Vector2d& p, double bearing) {
  const double dx = std::cos(bearing), dy = std::sin(bearing);
  const double x = dx > 0 ? (4.0 - p.x()) / dx : dx < 0 ? -p.x() / dx : INFINITY;
  const double y = dy > 0 ? (3.0 - p.y()) / dy : dy < 0 ? -p.y() / dy : INFINITY;
  return std::min(x, y);
}

TEST(Laser, MeetsFlatWallsExactlyAtTheCellEdge) {
  const World world = room();
  for (double bearing = -3.1; bearing < 3.2; bearing += 0.013) {
    const Eigen::Vector2d p(1.2345, 0.777);
    EXPECT_NEAR(castBeam(world, p, bearing, 8.0), truthInRoom(p, bearing), 1e-9) << bearing;
  }
}

TEST(Laser, IsFreeOfBiasOnAnObliqueRasterisedWall) {
  // Cells are full where their centre lies beyond the line n . p = d: edges scatter around it.
  const Eigen::Vector2d normal(std::cos(0.4), std::sin(0.4));
  const double wall = 5.0, side = 0.05;
  std::vector<unsigned char> cells(200 * 200, 0);
  for (int i = 0; i < 200 * 200; ++i) {
    const Eigen::Vector2d centre((i % 200 + 0.5) * side, (i / 200 + 0.5) * side);
    cells[i] = normal.dot(centre) > wall;
  }
  const World world("oblique", 200, 200, cells, side, {0.0, 0.0});
  double sum = 0.0;
  int count = 0;
  for (double offset = 0.5; offset < 2.5; offset += 0.0071) {
    const Eigen::Vector2d p = offset * Eigen::Vector2d(normal.y(), normal.x());
    const double range = castBeam(world, p, 0.4, 20.0);
    ASSERT_TRUE(std::isfinite(range));
    sum += range - (wall - normal.dot(p));
    ++count;
  }
  // The stairs of a raster stand out by about a fifth of a cell: 6 mm, while one cell is 50 mm.
  EXPECT_LT(std::abs(sum / count), 0.2 * side);
}

TEST(Laser, GivesNoReturnBeyondItsRangeAndKnowsHowFarItIsFree) {
  LaserParameters parameters;
  parameters.range = 0.5;
  Random random(1);
  const Scan scan = sweep(room(), {}, {2.0, 1.5, 0.3}, parameters, random);
  ASSERT_EQ(scan.size(), 361u);
  for (double range : scan.ranges) EXPECT_TRUE(isNoReturn(range));
  EXPECT_EQ(scan.free_range_without_return, 0.5);
}

TEST(Laser, NoiseHasTheGivenSpreadAndNoBias) {
  LaserParameters parameters;
  parameters.range_noise = 0.02;
  Random random(7);
  const Eigen::Vector2d p(1.7, 1.1);
  double sum = 0.0, sum_sq = 0.0;
  int count = 0;
  for (int i = 0; i < 50; ++i) {
    const Scan scan = sweep(room(), {}, {p.x(), p.y(), 0.2}, parameters, random);
    for (std::size_t beam = 0; beam < scan.size(); ++beam, ++count) {
      const double error = scan.ranges[beam] - truthInRoom(p, 0.2 + scan.bearing(beam));
      sum += error;
      sum_sq += error * error;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 5.0 * 0.02 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_sq / count), 0.02, 0.001);
}

TEST(Laser, DropsOutAtTheGivenShare) {
  LaserParameters parameters;
  parameters.dropout = 0.3;
  Random random(3);
  int invalid = 0;
  for (int i = 0; i < 20; ++i) {
    for (double range : sweep(room(), {}, {2.0, 1.5, 0.0}, parameters, random).ranges) {
      invalid += std::isnan(range);
    }
  }
  EXPECT_NEAR(invalid / (20.0 * 361.0), 0.3, 0.03);
}

TEST(Laser, SeesDiscsAndBoxesAtTheirSurface) {
  LaserParameters parameters;
  parameters.range_noise = 0.0;
  parameters.beams = 1;
  Random random(1);
  Body disc;
  disc.half_size = {0.3, 0.3};
  disc.T_map_body = {3.0, 1.0, 0.0};
  EXPECT_NEAR(sweep(room(), {disc}, {1.0, 1.0, 0.0}, parameters, random).ranges[0], 1.7, 1e-12);
  Body box;
  box.shape = Body::Shape::kBox;
  box.half_size = {0.2, 0.5};
  box.T_map_body = {3.0, 1.0, M_PI / 4};  // a corner region: the long side is met obliquely
  EXPECT_NEAR(sweep(room(), {box}, {1.0, 1.0, 0.0}, parameters, random).ranges[0],
              2.0 - 0.2 * std::sqrt(2.0), 1e-12);
}

TEST(Laser, CastsEachBeamFromWhereItIsByThen) {
  LaserParameters parameters;
  parameters.range_noise = 0.0;
  const std::vector<Body> nobody;
  const auto at = [&](double time) {
    return LaserPlace{{1.5 + 0.5 * time, 1.2, 0.2 + 1.3 * time}, nobody};
  };
  for (const double swept : {0.2, -0.2}) {
    parameters.sweep = swept;
    Random random(1);
    const Scan scan = sweep(room(), at, parameters, random);
    EXPECT_EQ(scan.sweep_duration, 0.2);  // the driver knows no sense
    EXPECT_EQ(scan.T_map_sensor.x, 1.5);
    for (const std::size_t beam : {0u, 50u, 180u, 300u, 360u}) {
      const double time = swept * (static_cast<double>(beam) / 360.0 - 0.5);
      const double bearing = 0.2 + 1.3 * time + scan.bearing(beam);
      EXPECT_NEAR(scan.ranges[beam], truthInRoom({1.5 + 0.5 * time, 1.2}, bearing), 1e-9) << beam;
    }
  }
}

TEST(Laser, NoiseThatGrowsWithTheRangeIsAShareOfIt) {
  LaserParameters parameters;
  parameters.range_noise = 0.0;
  parameters.range_noise_share = 0.01;
  Random random(5);
  double sum_sq = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Scan scan = sweep(room(), {}, {1.7, 1.1, 0.2}, parameters, random);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const double truth = truthInRoom({1.7, 1.1}, 0.2 + scan.bearing(beam));
      sum_sq += std::pow((scan.ranges[beam] - truth) / truth, 2);
    }
  }
  EXPECT_NEAR(std::sqrt(sum_sq / (20.0 * 361.0)), 0.01, 0.0005);
}

TEST(Laser, WritesMissingReturnsAsItsDriverDoes) {
  LaserParameters parameters;
  parameters.range = 2.0;
  parameters.dropout = 0.1;
  for (const auto& [missing, reading] :
       {std::pair(MissingReading::kInfinity, HUGE_VAL), std::pair(MissingReading::kZero, 0.0),
        std::pair(MissingReading::kRangeMax, 2.0)}) {
    parameters.missing = missing;
    Random random(2);
    const Scan scan = sweep(room(), {}, {0.4, 0.4, 0.0}, parameters, random);
    long missed = 0, others = 0;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const bool is_missing = scan.ranges[beam] == reading;
      const double truth = truthInRoom({0.4, 0.4}, scan.bearing(beam));
      missed += is_missing && truth > 2.1;
      others += is_missing && truth < 1.9;
      EXPECT_TRUE(is_missing || truth < 2.1);
    }
    EXPECT_GT(missed, 20);
    EXPECT_GT(others, 10);
  }
}

TEST(Laser, ModelsAreKnownByName) {
  const LaserModel& a1 = laserModel("rplidar_a1");
  EXPECT_NEAR(a1.laser.sweep, -1.0 / 5.5, 1e-3);
  EXPECT_EQ(laserModel("ideal").laser.sweep, 0.0);
  EXPECT_THROW(laserModel("rplidar"), std::runtime_error);
  for (const LaserModel& model : laserModels()) {
    EXPECT_LE(std::abs(model.laser.sweep) * model.rate, 1.0) << model.name;
  }
}

TEST(Laser, MrptsSimulatorIsSelectableAndLooksLessFar) {
  LaserParameters parameters;
  parameters.caster = Caster::kMrpt;
  parameters.range_noise = 0.0;
  Random random(1);
  const Eigen::Vector2d p(2.0, 1.5);
  const Scan scan = sweep(room(), {}, {p.x(), p.y(), 0.0}, parameters, random);
  EXPECT_NEAR(scan.free_range_without_return, 6.4, 1e-9);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    EXPECT_NEAR(scan.ranges[beam], truthInRoom(p, scan.bearing(beam)), 0.08);
  }
}

}  // namespace
}  // namespace cca
