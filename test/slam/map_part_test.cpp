// SPDX-License-Identifier: BSD-3-Clause
#include "slam/map_part.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

void connect(PoseGraph& graph, int from, int to) {
  graph.connect({from, to, {1.0, 0.0, 0.0}, Eigen::Matrix3d::Identity(), EdgeKind::kMatch});
}

/// Adds a chain of `nodes`; @return its first one.
int addPart(PoseGraph& graph, int nodes) {
  const int first = graph.add({});
  for (int k = 1; k < nodes; ++k) connect(graph, graph.add({}) - 1, first + k);
  return first;
}

TEST(MapPart, OfALostRobotIsWhatItHadMappedBefore) {
  PoseGraph graph;
  MapPart map;
  map.begin(addPart(graph, 2));
  EXPECT_FALSE(map.isLost(graph));
  const int lost = addPart(graph, 1);
  EXPECT_TRUE(map.isLost(graph));
  EXPECT_EQ(map.partToJoin(graph, lost), 0);
  connect(graph, 1, lost);
  map.update(graph);
  EXPECT_FALSE(map.isLost(graph));
  EXPECT_FALSE(map.partToJoin(graph, lost));
}

TEST(MapPart, OfARobotInAMemoryIsItsOwnDriveUntilBothAreJoined) {
  PoseGraph graph;
  MapPart map;
  addPart(graph, 5);
  map.remember(graph);
  EXPECT_FALSE(map.hasDriven(graph));
  EXPECT_TRUE(map.isInMemory(graph));
  const int own = addPart(graph, 2);
  map.begin(own);
  EXPECT_FALSE(map.isLost(graph));
  EXPECT_FALSE(map.isInMemory(graph));
  EXPECT_EQ(map.partToJoin(graph, own), 0);
  EXPECT_FALSE(map.partToJoin(graph, 3)) << "a remembered frame looks for nothing";
  connect(graph, 4, own);
  map.update(graph);
  EXPECT_TRUE(map.isInMemory(graph));
  EXPECT_TRUE(map.holds(graph, 0));
}

TEST(MapPart, IsAtTheEndTheLargestPartOfTheOwnDrive) {
  PoseGraph graph;
  MapPart map;
  addPart(graph, 9);
  map.remember(graph);
  const int first = addPart(graph, 2), second = addPart(graph, 4);
  map.begin(first);
  map.chooseLargest(graph);
  EXPECT_TRUE(map.holds(graph, second));
  EXPECT_FALSE(map.holds(graph, first));
}

}  // namespace
}  // namespace cca
