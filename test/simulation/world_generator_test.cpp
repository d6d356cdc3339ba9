// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/world_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cca_mrpt/simulation/coverage.hpp"

namespace cca {
namespace {

constexpr double kResolution = 0.05;

/// Number of regions, of at least a robot's size, where a disc of `radius` can stand.
int regionsFor(const World& world, double radius) {
  const int width = world.width(), height = world.height();
  std::vector<char> open(static_cast<std::size_t>(width) * height, 0);
  for (int i = 0; i < width * height; ++i) {
    const Eigen::Vector2d p = kResolution * Eigen::Vector2d(i % width + 0.5, i / width + 0.5);
    open[i] = !world.isObstacle(i % width, i / width) && world.clearance(p, radius) >= radius;
  }
  int regions = 0;
  for (int first = 0; first < width * height; ++first) {
    if (!open[first]) continue;
    std::vector<int> stack{first};
    open[first] = 0;
    int size = 0;
    for (; !stack.empty(); ++size) {
      const int cell = stack.back();
      stack.pop_back();
      for (int next : {cell - 1, cell + 1, cell - width, cell + width}) {
        if (open[next]) open[next] = 0, stack.push_back(next);
      }
    }
    regions += size > 4;
  }
  return regions;
}

class EveryKind : public testing::TestWithParam<std::string> {};

TEST_P(EveryKind, IsOneRegionForARobotWithItsMarginUnlessCrowded) {
  for (std::uint64_t seed : {1, 2}) {
    const World world = rasterise(generateBuilding(GetParam(), seed), kResolution);
    const int regions = regionsFor(world, 0.25 + 0.1);
    if (GetParam() == "crowded") {
      EXPECT_GT(regions, 1) << "of seed " << seed;
    } else {
      EXPECT_EQ(regions, 1) << GetParam() << " of seed " << seed;
    }
    EXPECT_NO_THROW(requireStandable(world, *world.start, 0.4));
  }
}

// Rooms whose middle is another start would be filled a little differently.
TEST(CrowdedBuilding, BeginsInItsLargestPart) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const World world = rasterise(generateBuilding("crowded", seed), kResolution);
    const double share = shareReached(world, world.start->position(), 0.25);
    double most = 0.0;
    for (double x = 1.0; x < world.width() * kResolution; x += 1.5) {
      for (double y = 1.0; y < world.height() * kResolution; y += 1.5)
        most = std::max(most, shareReached(world, {x, y}, 0.25));
    }
    EXPECT_GT(share, 0.9 * most) << seed;
  }
}

TEST_P(EveryKind, HasFreeSpaceBeforeEachTrueFaceAndSolidBehind) {
  const Building plan = generateBuilding(GetParam(), 1);
  const World world = rasterise(plan, kResolution);
  const auto faces = wallFaces(plan, kResolution);
  ASSERT_GE(faces.size(), 4U);
  for (const auto& [a, b] : faces) {
    const Eigen::Vector2d along = b - a;
    if (along.norm() < 0.2) continue;  // the stairs of the raster are as long
    const Eigen::Vector2d out = Eigen::Vector2d(along.y(), -along.x()).normalized();
    const Eigen::Vector2d middle = 0.5 * (a + b);
    const auto obstacle = [&world](const Eigen::Vector2d& p) {
      const Eigen::Vector2d cell = world.toCells(p);
      return world.isObstacle(static_cast<int>(cell.x()), static_cast<int>(cell.y()));
    };
    EXPECT_FALSE(obstacle(middle + 0.041 * out)) << middle.transpose();
    EXPECT_TRUE(obstacle(middle - 0.041 * out)) << middle.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, EveryKind, testing::ValuesIn(buildingKinds()),
                         [](const auto& kind) { return kind.param; });

TEST(WallFaces, OfTwoRoomsAreTheTwelveThatOneSees) {
  const auto faces = wallFaces(generateBuilding("two_rooms", 1), kResolution);
  EXPECT_EQ(faces.size(), 12u);
  double length = 0.0;
  for (const auto& [a, b] : faces) length += (b - a).norm();
  // Two rooms of 4.75 x 5.6 m, less the door of 1 m twice, plus its two reveals of 0.1 m.
  EXPECT_NEAR(length, 2.0 * 2.0 * (4.75 + 5.6) - 2.0 + 0.2, 1e-9);
}

TEST(GenerateFloorPlan, GivesTheSameForTheSameSeedAndElseAnother) {
  const auto corners = [](const Building& plan) {
    std::vector<double> all;
    for (const auto& solid : plan.solids) {
      for (const auto& p : solid) all.insert(all.end(), {p.x(), p.y()});
    }
    return all;
  };
  for (const char* kind : {"office", "maze", "random", "crowded"}) {
    EXPECT_EQ(corners(generateBuilding(kind, 4)), corners(generateBuilding(kind, 4)));
    EXPECT_NE(corners(generateBuilding(kind, 4)), corners(generateBuilding(kind, 5)));
  }
}

TEST(GenerateFloorPlan, NamesTheKindsThatThereAreForOneThatIsNot) {
  try {
    generateBuilding("castle", 1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("castle"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("two_rooms"), std::string::npos);
  }
}

}  // namespace
}  // namespace cca
