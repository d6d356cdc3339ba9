// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/map_messages.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

std::vector<MapLine> twoLines() {
  std::vector<MapLine> lines(2);
  lines[0].id = 7;
  lines[0].segment.start = {1.0, 2.0};
  lines[0].segment.end = {3.0, 2.0};
  lines[0].segment.covariance << 1e-4, 1e-5, 2e-5, 3e-6;
  lines[0].support = 120.0;
  lines[1].id = 9;
  lines[1].segment.start = {-1.0, 0.5};
  lines[1].segment.end = {-1.0, 8.25};
  return lines;
}

std_msgs::Header header() {
  std_msgs::Header h;
  h.frame_id = "map";
  h.stamp = ros::Time(5, 6);
  return h;
}

TEST(LineMapMessage, CarriesEachLineWhole) {
  const auto message = lineMapMessage(twoLines(), header());
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(5, 6));
  ASSERT_EQ(message.lines.size(), 2u);
  EXPECT_EQ(message.lines[0].id, 7u);
  EXPECT_EQ(message.lines[0].end.x, 3.0);
  EXPECT_EQ(message.lines[0].end.y, 2.0);
  EXPECT_EQ(message.lines[0].covariance[1], 1e-5);
  EXPECT_EQ(message.lines[0].covariance[2], 2e-5);
  EXPECT_EQ(message.lines[0].covariance[3], 3e-6);
  EXPECT_EQ(message.lines[0].support, 120.0);
  EXPECT_EQ(message.lines[1].id, 9u);
}

TEST(LineMarkers, AreOneListOfTheSameLinesInTheSameOrder) {
  const auto array = lineMarkers(twoLines(), header());
  ASSERT_EQ(array.markers.size(), 1u);
  const auto& marker = array.markers[0];
  EXPECT_EQ(marker.type, visualization_msgs::Marker::LINE_LIST);
  EXPECT_EQ(marker.action, visualization_msgs::Marker::ADD);
  EXPECT_EQ(marker.header.frame_id, "map");
  ASSERT_EQ(marker.points.size(), 4u);
  EXPECT_EQ(marker.points[1].x, 3.0);
  EXPECT_EQ(marker.points[3].y, 8.25);
  EXPECT_GT(marker.scale.x, 0.0);
  EXPECT_EQ(marker.pose.orientation.w, 1.0);  // rviz refuses the quaternion 0
}

TEST(LineMarkers, OfAnEmptyMapDeleteWhatStood) {
  const auto array = lineMarkers({}, header());
  ASSERT_EQ(array.markers.size(), 1u);
  EXPECT_EQ(array.markers[0].action, visualization_msgs::Marker::DELETE);
}

TEST(FrontierMarkers, AreSquaresOfTheCellsSize) {
  const auto array = frontierMarkers({{1.0, 2.0}, {3.0, 4.0}}, 0.1, header());
  ASSERT_EQ(array.markers.size(), 1u);
  EXPECT_EQ(array.markers[0].type, visualization_msgs::Marker::CUBE_LIST);
  EXPECT_EQ(array.markers[0].scale.x, 0.1);
  ASSERT_EQ(array.markers[0].points.size(), 2u);
  EXPECT_EQ(array.markers[0].points[1].y, 4.0);
}

TEST(LoopMarkers, LeadFromEachVisitToTheEarlierOne) {
  const auto markers = loopMarkers({{1.0, 2.0}, {3.0, 4.0}}, header());
  ASSERT_EQ(markers.markers.size(), 1U);
  ASSERT_EQ(markers.markers[0].points.size(), 2U);
  EXPECT_EQ(markers.markers[0].type, visualization_msgs::Marker::LINE_LIST);
  EXPECT_EQ(markers.markers[0].points[1].x, 3.0);
  EXPECT_EQ(loopMarkers({}, header()).markers[0].action, visualization_msgs::Marker::DELETE);
}

}  // namespace
}  // namespace cca
