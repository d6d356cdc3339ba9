// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

/// `lines` and `line_markers`, latched.
class LinePublisher {
 public:
  LinePublisher(ros::NodeHandle& node, std::string frame);
  void publish(const std::vector<MapLine>& lines, const ros::Time& stamp);

 private:
  std::string frame_;
  ros::Publisher lines_, markers_;
};

}  // namespace cca
