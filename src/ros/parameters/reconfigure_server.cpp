// SPDX-License-Identifier: BSD-3-Clause
#include "reconfigure_server.hpp"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/config_tools.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cca {
namespace {

constexpr const char* kGroup = "Default";  // the one that clients look for, number 0

}  // namespace

ReconfigureServer::ReconfigureServer(const ros::NodeHandle& private_node,
                                     std::vector<Number> numbers, std::function<void()> changed)
    : node_(private_node),
      numbers_(std::move(numbers)),
      changed_(std::move(changed)),
      descriptions_(node_.advertise<dynamic_reconfigure::ConfigDescription>(
          "parameter_descriptions", 1, true)),
      updates_(node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true)),
      service_(node_.advertiseService("set_parameters", &ReconfigureServer::onSet, this)) {
  describe();
  updates_.publish(now());
}

void ReconfigureServer::describe() {
  dynamic_reconfigure::ConfigDescription description;
  description.groups.resize(1);
  description.groups[0].name = kGroup;
  for (const Number& number : numbers_) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = number.name;
    parameter.type = "double";
    parameter.description = number.meaning;
    description.groups[0].parameters.push_back(parameter);
  }
  description.min = config([](const Number& number) { return number.lowest; });
  description.max = config([](const Number& number) { return number.highest; });
  description.dflt = now();
  descriptions_.publish(description);
}

dynamic_reconfigure::Config ReconfigureServer::config(
    const std::function<double(const Number&)>& value) const {
  dynamic_reconfigure::Config config;
  for (const Number& number : numbers_) {
    dynamic_reconfigure::ConfigTools::appendParameter(config, number.name, value(number));
  }
  config.groups.resize(1);
  config.groups[0].name = kGroup;
  config.groups[0].state = true;
  return config;
}

dynamic_reconfigure::Config ReconfigureServer::now() const {
  return config([](const Number& number) { return *number.value; });
}

void ReconfigureServer::set(const std::string& name, double value) {
  const auto number = std::find_if(numbers_.begin(), numbers_.end(),
                                   [&](const Number& other) { return other.name == name; });
  if (number == numbers_.end() || std::isnan(value)) {
    ROS_WARN("%s := %g is not to be had while the node runs", name.c_str(), value);
    return;
  }
  *number->value = std::clamp(value, number->lowest, number->highest);
  node_.setParam(number->parameter, *number->value);
  ROS_INFO("%s := %g", number->parameter.c_str(), *number->value);
}

bool ReconfigureServer::onSet(dynamic_reconfigure::Reconfigure::Request& request,
                              dynamic_reconfigure::Reconfigure::Response& response) {
  for (const auto& asked : request.config.doubles) set(asked.name, asked.value);
  changed_();
  response.config = now();
  updates_.publish(response.config);
  return true;
}

}  // namespace cca
