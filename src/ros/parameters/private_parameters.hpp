// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/parameters.hpp"

namespace cca {

/// A node's private parameters: those of the node itself, and every one of the program's
/// (`section/name`, or `name` alone where one section only has it: `_strategy:=greedy`). Values are
/// checked as those of the .ini file and the command line are.
class PrivateParameters {
 public:
  explicit PrivateParameters(const ros::NodeHandle& private_node) : node_(private_node) {}

  // Each sets the value where the parameter is given.
  // @throws std::runtime_error naming the parameter, its value and what is allowed.
  void text(const std::string& name, std::string& value);
  /// A text that is not empty. @param what  it is.
  void path(const std::string& name, std::string& value, const std::string& what);
  /// A frame of tf, without the slash that it may begin with. @param other  that it must not be.
  void frame(const std::string& name, std::string& value, const std::string& other = "");
  /// A topic; none where it is empty.
  void topic(const std::string& name, std::string& value);
  void flag(const std::string& name, bool& value);
  /// int or double.
  template <class Number>
  void number(const std::string& name, Number& value, Number lowest, Number highest,
              const std::string& unit);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed);
  /// One or more names: a list, or the same as text, `[a, b]`, as rosrun's command line gives it.
  void names(const std::string& name, std::vector<std::string>& value);
  /// Warns where a parameter is given that is the node's own, but is not used this time.
  void withoutEffect(const std::string& name);
  /// The program's parameters of these sections; those of the .ini file that `~config` names come
  /// first. Of the other sections' it is told that they have no effect. To be called after the
  /// node's own were read: a short name that is one of these is not the program's.
  void program(Parameters& p, const std::vector<std::string>& sections);

  /// Warns of parameters that lack their underscore: they give topics other names.
  /// @throws std::runtime_error naming what nobody asked for, and all that there is.
  void refuseUnknown() const;

 private:
  /// As one would write it in an .ini file; nothing where it is not given.
  std::optional<std::string> given(const std::string& name);
  [[noreturn]] void refuse(const std::string& name, const std::string& value,
                           const std::string& allowed) const;

  ros::NodeHandle node_;
  std::vector<std::string> known_, unused_;
};

}  // namespace cca
