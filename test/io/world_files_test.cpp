// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/world_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "cca_mrpt/simulation/world_generator.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

class Shipped : public testing::TestWithParam<std::string> {};

TEST_P(Shipped, WorldIsWhatTheGeneratorMakesByteForByte) {
  const std::string folder = testing::TempDir() + "cca_worlds";
  writeWorldFiles(generateBuilding(GetParam(), 1), folder);
  for (const char* extension : {".yaml", ".png", ".truth.csv"}) {
    const std::string name = "/" + GetParam() + extension;
    EXPECT_EQ(bytesOf(folder + name), bytesOf(CCA_MAPS_FOLDER + name)) << name;
  }
}

TEST_P(Shipped, WorldLoadsAsItWasDrawn) {
  const Building plan = generateBuilding(GetParam(), 1);
  const World drawn = rasterise(plan, kWorldResolution);
  const World loaded = loadWorld(std::string(CCA_MAPS_FOLDER) + "/" + GetParam() + ".yaml");
  ASSERT_EQ(loaded.width(), drawn.width());
  ASSERT_EQ(loaded.height(), drawn.height());
  EXPECT_EQ(loaded.grid().getRawMap(), drawn.grid().getRawMap());
  ASSERT_TRUE(loaded.start);
  EXPECT_NEAR(loaded.start->x, plan.start.x, 1e-9);
  EXPECT_TRUE(loaded.unknown_keys.empty());
}

std::vector<std::string> shippedKinds() {
  std::vector<std::string> kinds = buildingKinds();
  kinds.erase(std::remove(kinds.begin(), kinds.end(), "crowded"), kinds.end());
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Worlds, Shipped, testing::ValuesIn(shippedKinds()),
                         [](const auto& kind) { return kind.param; });

TEST(WorldFiles, RefusesNamesThatLeaveTheFolderOrBreakTheYaml) {
  const TemporaryFolder folder;
  Building plan = generateBuilding("two_rooms", 1);
  for (const char* name : {"", "../a", "a/b", "a: b", ".hidden", "caf\xE9"}) {
    plan.name = name;
    EXPECT_THROW(writeWorldFiles(plan, folder.path()), std::runtime_error) << name;
  }
}

}  // namespace
}  // namespace cca
