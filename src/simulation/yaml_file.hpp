// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/containers/yaml.h>

#include <string>
#include <vector>

namespace cca {

/// A map node of a YAML file whose readers throw std::runtime_error naming file, key, the value
/// found and what is allowed.
class YamlNode {
 public:
  /// @throws std::runtime_error where the file is missing or no YAML mapping, or gives a key twice.
  static YamlNode load(const std::string& path);

  bool has(const std::string& key) const;
  std::vector<std::string> keys() const;
  double number(const std::string& key, double lowest, double highest) const;
  double number(const std::string& key, double lowest, double highest, double otherwise) const;
  std::string text(const std::string& key) const;
  std::string choice(const std::string& key, const std::vector<std::string>& allowed,
                     const std::string& otherwise) const;
  /// A list of numbers. @param size  how many; 0: any number of them.
  std::vector<double> numbers(const std::string& key, std::size_t size) const;
  /// A list of lists of `size` numbers.
  std::vector<std::vector<double>> rows(const std::string& key, std::size_t size) const;
  /// A list of mappings; empty where the key is absent.
  std::vector<YamlNode> list(const std::string& key) const;
  /// @throws std::runtime_error where a key is not among `allowed`.
  void allowOnly(const std::vector<std::string>& allowed) const;

  [[noreturn]] void fail(const std::string& key, const std::string& complaint) const;

 private:
  using Node = mrpt::containers::yaml::node_t;
  YamlNode(std::string where, mrpt::containers::yaml::map_t entries)
      : where_(std::move(where)), entries_(std::move(entries)) {}
  const Node* find(const std::string& key) const;
  const Node& at(const std::string& key) const;
  double toNumber(const std::string& key, const Node& value) const;

  std::string where_;  // file, and the place in it
  mrpt::containers::yaml::map_t entries_;
};

}  // namespace cca
