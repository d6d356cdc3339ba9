// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/hazard_message.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

namespace cca {
namespace {

constexpr double kApart = 0.04;  // m, on an arc: below the cells that ways are planned on

/// Where in a point its coordinate stands.
std::size_t offsetOf(const sensor_msgs::PointCloud2& m, const char* name) {
  const auto field = std::find_if(m.fields.begin(), m.fields.end(),
                                  [name](const auto& other) { return other.name == name; });
  const bool is_sound = field != m.fields.end() &&
                        field->datatype == sensor_msgs::PointField::FLOAT32 &&
                        field->offset <= m.point_step && m.point_step - field->offset >= 4;
  if (!is_sound) throw std::runtime_error(std::string("PointCloud2: no 32-bit field ") + name);
  return field->offset;
}

}  // namespace

std::vector<Eigen::Vector3d> hazardPoints(const sensor_msgs::PointCloud2& m) {
  if (m.is_bigendian) throw std::runtime_error("PointCloud2: is_bigendian is not supported");
  const std::uint64_t row = std::uint64_t{m.width} * m.point_step;
  if (row > m.row_step || std::uint64_t{m.height} * m.row_step > m.data.size()) {
    throw std::runtime_error("PointCloud2: fewer bytes than width, height and steps say");
  }
  const std::size_t offsets[]{offsetOf(m, "x"), offsetOf(m, "y"), offsetOf(m, "z")};
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < m.height; ++i) {
    for (std::size_t j = 0; j < m.width; ++j) {
      const std::uint8_t* point = m.data.data() + i * m.row_step + j * m.point_step;
      Eigen::Vector3f p;
      for (int k = 0; k < 3; ++k) std::memcpy(&p[k], point + offsets[k], sizeof p[k]);
      if (p.cast<double>().norm() <= kFarthestHazard)
        points.push_back(p.cast<double>());  // NaN is not
    }
  }
  return points;
}

std::vector<Eigen::Vector3d> hazardPoints(const sensor_msgs::Range& m) {
  if (!(m.min_range >= 0.0f && m.max_range >= m.min_range)) {
    throw std::runtime_error("Range: min_range and max_range are no limits");
  }
  if (!(m.field_of_view >= 0.0f && m.field_of_view <= static_cast<float>(M_PI))) {
    throw std::runtime_error("Range: field_of_view must be in [0, pi]");
  }
  const bool is_detection = std::isinf(m.range) && m.range < 0.0f;
  const double range = is_detection ? m.min_range : m.range;
  if (!(range >= m.min_range && range <= m.max_range && range <= kFarthestHazard)) return {};
  const int pieces = static_cast<int>(std::ceil(range * m.field_of_view / kApart));
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k <= pieces; ++k) {
    const double share = pieces > 0 ? static_cast<double>(k) / pieces - 0.5 : 0.0;
    const double bearing = share * m.field_of_view;
    points.emplace_back(range * std::cos(bearing), range * std::sin(bearing), 0.0);
  }
  return points;
}

}  // namespace cca
