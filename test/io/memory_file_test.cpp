// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/memory_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <future>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

StoredMemory twoFrames() {
  StoredMemory stored;
  stored.origin = {1000.0, -2000.0};
  KeyScan key;
  key.scan.angle_min = -0.5;
  key.scan.angle_increment = 0.25;
  key.scan.free_range_without_return = 8.0;
  key.scan.ranges = {1.5, HUGE_VAL, std::numeric_limits<double>::quiet_NaN(), 2.25, 0.0};
  key.T_robot_sensor = {0.1, 0.2, 0.3};
  stored.memory.scans = {key, key};
  stored.memory.graph.add({1.0, 2.0, 0.5});
  stored.memory.graph.add({1.5, 2.0, 0.5});
  GraphEdge edge{0, 1, {0.4, -0.2, 0.01}, Eigen::Matrix3d::Identity(), EdgeKind::kWheels};
  edge.information(0, 2) = edge.information(2, 0) = 0.25;
  stored.memory.graph.connect(edge);
  return stored;
}

TEST(MemoryFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  writeFile(folder / kMemoryFile, packedMemory(twoFrames()));
  const StoredMemory loaded = loadMemory(folder.path());
  EXPECT_EQ(packedMemory(loaded), packedMemory(twoFrames()));
  ASSERT_EQ(loaded.memory.graph.size(), 2);
  EXPECT_EQ(loaded.memory.graph.pose(1).x, 1.5);
  EXPECT_EQ(loaded.memory.scans[0].scan.ranges[3], 2.25);
  EXPECT_TRUE(std::isnan(loaded.memory.scans[0].scan.ranges[2]));
  EXPECT_EQ(loaded.memory.scans[0].T_robot_sensor.theta, 0.3);
  EXPECT_EQ(loaded.memory.graph.edges().front().kind, EdgeKind::kWheels);
  EXPECT_EQ(loaded.memory.graph.edges().front().information(2, 0), 0.25);
}

// Runs side by side end in one second, and each leaves its own.
TEST(MemoryFile, IsTheSameHoweverManyAreWrittenAtOnce) {
  const std::string alone = packedMemory(twoFrames());
  std::vector<std::future<std::string>> others;
  for (int k = 0; k < 20; ++k) {
    others.push_back(std::async(std::launch::async, [] { return packedMemory(twoFrames()); }));
  }
  for (auto& other : others) EXPECT_EQ(other.get(), alone);
}

TEST(MemoryFile, WhatIsNotThereIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { loadMemory(folder.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("map.slam: is not there")));
}

TEST(MemoryFile, DamageIsSaidAndNeverBelieved) {
  const TemporaryFolder folder;
  const std::string whole = packedMemory(twoFrames()), file = folder / kMemoryFile;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    writeFile(file, whole.substr(0, length));
    EXPECT_THROW(loadMemory(file), std::runtime_error) << length;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string wrong = whole;
    wrong[at] = static_cast<char>(wrong[at] ^ 0x15);
    writeFile(file, wrong);
    try {
      loadMemory(file);
    } catch (const std::runtime_error&) {  // some bytes matter to nobody
    }
  }
}

TEST(MemoryFile, AnEdgeToNowhereIsRefused) {
  const TemporaryFolder folder;
  StoredMemory stored = twoFrames();
  GraphEdge edge = stored.memory.graph.edges().front();
  stored.memory.graph.add({});
  stored.memory.scans.push_back({});
  edge.to = 2;
  edge.T_from_to.x = std::numeric_limits<double>::infinity();
  stored.memory.graph.connect(edge);
  writeFile(folder / kMemoryFile, packedMemory(stored));
  EXPECT_THAT([&] { loadMemory(folder.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace cca
