// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/beam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cca {
namespace {

/// Beams of a degree each over `degrees` from `first` on, either way around.
Scan scanOver(int degrees, double first, double increment = M_PI / 180.0) {
  Scan scan;
  scan.angle_min = first;
  scan.angle_increment = increment;
  scan.ranges.assign(static_cast<std::size_t>(degrees), 1.0);
  return scan;
}

TEST(LooksTowards, PlacesBetweenTheFirstAndTheLastBeamHoweverFar) {
  Scan scan = scanOver(91, -M_PI_4);
  scan.T_map_sensor = {1.0, 2.0, M_PI_2};  // along y
  EXPECT_TRUE(looksTowards(scan, {1.0, 100.0}));
  EXPECT_TRUE(looksTowards(scan, {1.9, 3.0}));
  EXPECT_FALSE(looksTowards(scan, {2.1, 3.0}));
  EXPECT_FALSE(looksTowards(scan, {1.0, 1.0}));
  const Scan clockwise = scanOver(91, M_PI_4, -M_PI / 180.0);
  EXPECT_TRUE(looksTowards(clockwise, {1.0, -0.9}));
  EXPECT_FALSE(looksTowards(clockwise, {-1.0, 0.0}));
  EXPECT_FALSE(looksTowards(Scan{}, {1.0, 0.0}));
}

TEST(SectorsInView, AreThoseOfTheBeamsInTheMapFrame) {
  EXPECT_EQ(sectorsInView(scanOver(360, -M_PI)), 0xFFFFFFFFu);
  const Scan quarter = scanOver(90, 0.001);
  EXPECT_EQ(sectorsInView(quarter), 0x1FFu) << "eight, and the one that the last beam looks into";
  Scan turned = quarter;
  turned.T_map_sensor.theta = M_PI;
  EXPECT_EQ(sectorsInView(turned), 0x1FFu << 16);
  turned.T_map_sensor.theta = -M_PI_2;
  EXPECT_EQ(sectorsInView(turned), 0xFF000001u) << "across the x axis";
  EXPECT_EQ(sectorsInView(scanOver(90, M_PI_2 - 0.001, -M_PI / 180.0)), 0x1FFu);
}

TEST(SectorsInView, AreNoneOfAScanWithoutBeamsOrThatIsNotFinite) {
  EXPECT_EQ(sectorsInView(Scan{}), 0u);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sectorsInView(scanOver(90, kNaN)), 0u);
  EXPECT_EQ(sectorsInView(scanOver(90, 0.0, kNaN)), 0u);
}

}  // namespace
}  // namespace cca
