// SPDX-License-Identifier: BSD-3-Clause
#include "line_publisher.hpp"

#include "ros/messages/map_messages.hpp"
#include "ros/messages/pose_message.hpp"

namespace cca {

LinePublisher::LinePublisher(ros::NodeHandle& node, std::string frame)
    : frame_(std::move(frame)),
      lines_(node.advertise<cca_mrpt::LineMap>("lines", 2, true)),
      markers_(node.advertise<visualization_msgs::MarkerArray>("line_markers", 2, true)) {}

void LinePublisher::publish(const std::vector<MapLine>& lines, const ros::Time& stamp) {
  const std_msgs::Header header = headerMessage(frame_, stamp);
  lines_.publish(lineMapMessage(lines, header));
  markers_.publish(lineMarkers(lines, header));
}

}  // namespace cca
