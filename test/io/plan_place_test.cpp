// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/plans/plan_formats.hpp"

namespace cca {
namespace {

using testing::HasSubstr;
using testing::Not;

FloorPlan oneRoom() {
  FloorPlan plan;
  PlanRoom room;
  room.id = 1;
  room.outline = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  room.area = 24.0;
  room.label = {3, 2};
  plan.rooms = {room};
  return plan;
}

TEST(PlanPlace, TellsThatItIsInMetresWhereNobodyKnowsTheOrigin) {
  const auto json = nlohmann::json::parse(planGeoJson(oneRoom()));
  EXPECT_THAT(json.at("note").get<std::string>(), HasSubstr("metres"));
  EXPECT_FALSE(json.contains("origin") || json.contains("crs"));
  EXPECT_THAT(planSvg(oneRoom(), "room"), Not(HasSubstr(">N<")));
}

TEST(PlanPlace, IsInDegreesWhereTheOriginIsTold) {
  const GeoReference place{48.0, 11.0, 90.0};
  const auto json = nlohmann::json::parse(planGeoJson(oneRoom(), place));
  EXPECT_FALSE(json.contains("note"));
  EXPECT_EQ(json.at("origin"), nlohmann::json({48.0, 11.0, 90.0}));
  const auto& room = json.at("features").at(0);
  const auto corner = room.at("geometry").at("coordinates").at(0).at(1);
  // The map's x points north: 6 m of a degree of 111.2 km there.
  EXPECT_NEAR(corner.at(0).get<double>(), 11.0, 1e-8);
  EXPECT_NEAR(corner.at(1).get<double>(), 48.0 + 6.0 / 111200.0, 1e-7);
  EXPECT_EQ(room.at("properties").at("label_point"), nlohmann::json({3.0, 2.0}));
  EXPECT_THAT(planSvg(oneRoom(), "room", place), HasSubstr(">N<"));
}

}  // namespace
}  // namespace cca
