// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/boundary_trace.hpp"

#include <gtest/gtest.h>

#include "box_world.hpp"

namespace cca::testing {
namespace {

bool always(const Eigen::Vector2d&) { return true; }

ConfigurationSpace sampled(const std::vector<Box>& boxes) {
  ConfigurationSpace space;
  space.radius = 0.3;
  for (const Box& box : boxes) {
    for (double x = box.low.x(); x < box.high.x() + 1e-9; x += 0.05) {
      space.obstacles.push_back({x, box.low.y()});
      space.obstacles.push_back({x, box.high.y()});
    }
    for (double y = box.low.y(); y < box.high.y() + 1e-9; y += 0.05) {
      space.obstacles.push_back({box.low.x(), y});
      space.obstacles.push_back({box.high.x(), y});
    }
  }
  return space;
}

TEST(BoundaryTrace, AroundOnePointIsACircle) {
  const ConfigurationSpace space{{{1, 1}}, 0.3};
  const double around = 2.0 * M_PI * 0.3;
  const auto trace = traceBoundary(space, {2, 1}, false, around, always);
  for (const BoundaryPoint& p : trace)
    EXPECT_NEAR((p.center_map - Eigen::Vector2d(1, 1)).norm(), 0.3, 1e-9);
  EXPECT_NEAR(trace.back().heading - trace.front().heading, 2.0 * M_PI, 0.36);
}

TEST(BoundaryTrace, AroundABoxHasItsPerimeterAndOneWholeTurn) {
  const ConfigurationSpace space = sampled({{{0, 0}, {2, 1}}});
  const double perimeter = 6.0 + 2.0 * M_PI * 0.3;
  for (bool on_the_right : {false, true}) {
    const auto trace = traceBoundary(space, {1.0, -0.3}, on_the_right, perimeter, always);
    EXPECT_LT((trace.back().center_map - trace.front().center_map).norm(), 0.15);
    EXPECT_NEAR(trace.back().heading - trace.front().heading, on_the_right ? -2 * M_PI : 2 * M_PI,
                0.4);
    for (const BoundaryPoint& p : trace) EXPECT_NEAR(space.clearance(p.center_map), 0.3, 1e-6);
  }
}

TEST(BoundaryTrace, InsideARoomTurnsTheOtherWay) {
  const ConfigurationSpace space = sampled({{{0, 0}, {3, 2}}});
  const double inside = 2.0 * (3.0 - 0.6) + 2.0 * (2.0 - 0.6);
  const auto trace = traceBoundary(space, {1.5, 0.3}, true, inside, always);
  EXPECT_NEAR(trace.back().heading - trace.front().heading, 2.0 * M_PI, 0.4);
  EXPECT_LT((trace.back().center_map - trace.front().center_map).norm(), 0.15);
}

TEST(BoundaryTrace, DoesNotEnterAGapThatIsTooNarrowAndEntersAWiderOne) {
  for (double gap : {0.5, 0.75}) {
    const ConfigurationSpace space = sampled({{{0, 0}, {2, 1}}, {{2 + gap, 0}, {4 + gap, 1}}});
    const auto trace = traceBoundary(space, {1.0, -0.3}, false, 2.5, always);
    const bool enters = std::any_of(trace.begin(), trace.end(),
                                    [](const BoundaryPoint& p) { return p.center_map.y() > 0.2; });
    EXPECT_EQ(enters, gap > 0.6) << gap;
  }
}

TEST(BoundaryTrace, EndsWhereItIsToldTo) {
  const ConfigurationSpace space = sampled({{{0, 0}, {2, 1}}});
  const auto trace = traceBoundary(space, {1.0, -0.3}, false, 10.0,
                                   [](const Eigen::Vector2d& p) { return p.x() < 1.5; });
  EXPECT_LT(trace.back().center_map.x(), 1.5);
  EXPECT_TRUE(traceBoundary({{}, 0.3}, {0, 0}, true, 1.0, always).empty());
}

}  // namespace
}  // namespace cca::testing
