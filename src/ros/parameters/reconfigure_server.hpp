// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/ros.h>

#include <functional>
#include <string>
#include <vector>

namespace cca {

/// Numbers that may be changed while the node runs, by the protocol of dynamic_reconfigure:
/// `~set_parameters`, `~parameter_descriptions` and `~parameter_updates`, for rqt_reconfigure and
/// dynparam. Its generated code is not used: describe() says already what there is.
class ReconfigureServer {
 public:
  struct Number {
    std::string name;
    std::string parameter;  ///< private, that holds it
    std::string meaning;
    double lowest = 0.0, highest = 0.0;
    double* value = nullptr;  ///< outlives the server
  };

  /// @param changed  called after values have changed.
  ReconfigureServer(const ros::NodeHandle& private_node, std::vector<Number> numbers,
                    std::function<void()> changed);
  ReconfigureServer(const ReconfigureServer&) = delete;
  ReconfigureServer& operator=(const ReconfigureServer&) = delete;

 private:
  /// Values out of range become the nearest that is allowed; names that are none are warned of.
  bool onSet(dynamic_reconfigure::Reconfigure::Request& request,
             dynamic_reconfigure::Reconfigure::Response& response);
  void set(const std::string& name, double value);
  dynamic_reconfigure::Config config(const std::function<double(const Number&)>& value) const;
  dynamic_reconfigure::Config now() const;
  void describe();

  ros::NodeHandle node_;
  std::vector<Number> numbers_;
  std::function<void()> changed_;
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer service_;
};

}  // namespace cca
