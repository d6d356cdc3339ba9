// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/hazard_message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace cca::hazard_message_test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A row of points with a colour before their coordinates.
sensor_msgs::PointCloud2 cloudOf(const std::vector<Eigen::Vector3f>& points) {
  sensor_msgs::PointCloud2 cloud;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.point_step = 16;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.row_step);
  const char* names[] = {"rgb", "x", "y", "z"};
  for (std::uint32_t k = 0; k < 4; ++k) {
    sensor_msgs::PointField field;
    field.name = names[k];
    field.offset = 4 * k;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&cloud.data[16 * i + 4], points[i].data(), 12);
  }
  return cloud;
}

sensor_msgs::Range rangeOf(float range, float field_of_view) {
  sensor_msgs::Range message;
  message.min_range = 0.05f, message.max_range = 2.0f;
  message.range = range, message.field_of_view = field_of_view;
  return message;
}

TEST(HazardMessage, PointsOfACloudThatAreFiniteAndNear) {
  const auto points = hazardPoints(
      cloudOf({{1, 2, 0.5f}, {kNaN, 0, 0}, {100, 0, 0}, {-0.25f, 0, 0}, {kInf, 0, 0}}));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0], Eigen::Vector3d(1, 2, 0.5));
  EXPECT_EQ(points[1], Eigen::Vector3d(-0.25, 0, 0));
  EXPECT_TRUE(hazardPoints(cloudOf({})).empty());
}

TEST(HazardMessage, CloudsThatDoNotHoldWhatTheySayAreRefused) {
  const auto refuses = [](auto spoil) {
    sensor_msgs::PointCloud2 cloud = cloudOf({{1, 2, 3}, {4, 5, 6}});
    spoil(cloud);
    EXPECT_THROW(hazardPoints(cloud), std::runtime_error);
  };
  refuses([](auto& cloud) { cloud.data.resize(20); });
  refuses([](auto& cloud) { cloud.width = 3; });
  refuses([](auto& cloud) { cloud.height = 0xffffffff; });
  refuses([](auto& cloud) { cloud.is_bigendian = true; });
  refuses([](auto& cloud) { cloud.fields.pop_back(); });
  refuses([](auto& cloud) { cloud.fields[1].datatype = sensor_msgs::PointField::FLOAT64; });
  refuses([](auto& cloud) { cloud.fields[3].offset = 14; });
}

TEST(HazardMessage, ARangeIsAnArcWithoutHoles) {
  const auto points = hazardPoints(rangeOf(1.5f, 0.5f));
  ASSERT_GE(points.size(), 2u);
  for (const auto& p : points) EXPECT_NEAR(p.norm(), 1.5, 1e-6);
  EXPECT_NEAR(std::atan2(points.front().y(), points.front().x()), -0.25, 1e-6);
  EXPECT_NEAR(std::atan2(points.back().y(), points.back().x()), 0.25, 1e-6);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LT((points[i] - points[i - 1]).norm(), 0.05);
  }
  EXPECT_EQ(hazardPoints(rangeOf(1.5f, 0.0f)).size(), 1u);
}

TEST(HazardMessage, RangesAsRep117HasThem) {
  for (const float nothing : {kInf, kNaN, 2.1f, 0.01f, 0.0f, -1.0f}) {
    EXPECT_TRUE(hazardPoints(rangeOf(nothing, 0.1f)).empty()) << nothing;
  }
  const auto detected = hazardPoints(rangeOf(-kInf, 0.0f));
  ASSERT_EQ(detected.size(), 1u);
  EXPECT_NEAR(detected[0].x(), 0.05, 1e-6);
}

TEST(HazardMessage, RangesWithoutLimitsAreRefused) {
  for (const float bad : {kNaN, -1.0f, 4.0f}) {
    EXPECT_THROW(hazardPoints(rangeOf(1.0f, bad)), std::runtime_error);
  }
  sensor_msgs::Range message = rangeOf(1.0f, 0.1f);
  message.max_range = kNaN;
  EXPECT_THROW(hazardPoints(message), std::runtime_error);
}

}  // namespace
}  // namespace cca::hazard_message_test
