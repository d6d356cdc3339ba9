// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/yaml_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cca {

namespace {

using mrpt::containers::yaml;

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

constexpr std::size_t kDeepest = 100;  // levels; these files need three

/// At least as many levels as a YAML text can have: brackets that are open at a time, or what may
/// stand before the first word of a line.
std::size_t deepestNesting(const std::string& text) {
  std::size_t deepest = 0, open = 0, before_word = 0;
  bool in_word = false;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      before_word = 0;
      in_word = false;
    }
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    in_word = in_word || std::strchr(" \t\r\n-?:[{", c) == nullptr;
    if (!in_word) ++before_word;
    deepest = std::max({deepest, open, before_word});
  }
  return deepest;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// The first key of a YAML text that neither its line nor a deeper one gives a value; empty: none.
std::string keyWithoutValue(const std::string& text) {
  std::istringstream lines(text);
  std::string key;
  std::size_t indent = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    if (!key.empty() && begin <= indent && line[begin] != '-') return key;
    const std::size_t last = line.find_last_not_of(" \t\r");
    key = line[last] == ':' ? line.substr(begin, last - begin) : "";
    indent = begin;
  }
  return key;
}

/// Whether nothing but one colon, white space and comments stands from the end of a key to the
/// first letter of its value, or the quotes of both.
bool isOnePair(const std::string& between) {
  bool after_colon = false;
  for (std::size_t i = 0; i < between.size(); ++i) {
    const char c = between[i];
    if (i > 0 && c == '#' && std::isspace(static_cast<unsigned char>(between[i - 1])))
      i = std::min(between.find('\n', i), between.size());
    const bool is_quote = c == '"' || c == '\'';
    if (after_colon && (c == ':' || (is_quote && i + 1 < between.size()))) return false;
    after_colon = after_colon || c == ':';
  }
  return true;
}

/// MRPT keeps of a key that is given twice where it stood first, and the value that came last: then
/// more stands between the two than in a pair.
void refuseRepeatedKeys(const std::string& path, const std::string& text,
                        const yaml::node_t& node) {
  if (node.isSequence()) {
    for (const auto& entry : node.asSequence()) refuseRepeatedKeys(path, text, entry);
  }
  if (!node.isMap()) return;
  for (const auto& [key, value] : node.asMap()) {
    const auto name = key.as<std::string>();
    const std::size_t begin = std::min(key.marks.input_pos + name.size(), text.size());
    const std::size_t end = std::max(begin, value.marks.input_pos);
    if (!isOnePair(text.substr(begin, end - begin))) {
      throw std::runtime_error(path + ": " + name + ": is given twice, first in line " +
                               std::to_string(key.marks.line + 1));
    }
    refuseRepeatedKeys(path, text, value);
  }
}

/// A key of our own behind all others. MRPT keeps what stands before an error in a text, and tells
/// nobody but the error output: only where this key is read all has been.
const std::string kLastKey = "end_of_the_text";

/// The text with that key, at the depth of its first one and before the mark that ends the
/// document; as it is where it has no lines of keys.
std::string withLastKey(const std::string& text) {
  std::istringstream lines(text);
  std::string whole;
  std::optional<std::string> depth;
  for (std::string line; std::getline(lines, line);) {
    const bool is_mark = line.rfind("---", 0) == 0 || line.rfind("...", 0) == 0;
    if (is_mark && depth) break;
    whole += line + "\n";
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (is_mark || depth || begin == std::string::npos || line[begin] == '#') continue;
    if (line[begin] == '{' || line[begin] == '-') return text;
    depth = line.substr(0, begin);
  }
  return depth ? whole + *depth + kLastKey + ": 0\n" : text;
}

}  // namespace

YamlNode YamlNode::load(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw std::runtime_error(path + ": cannot be read");
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw std::runtime_error(path + ": cannot be read");
  if (text.find('\0') != std::string::npos) {
    throw std::runtime_error(path + ": is no text ('cca-mrpt info' tells whether it is a log)");
  }
  // MRPT's YAML library hangs on a malformed directive, and these files need none.
  if (text.rfind('%', 0) == 0 || text.find("\n%") != std::string::npos ||
      text.find("\r%") != std::string::npos) {
    throw std::runtime_error(path + ": YAML directives (%...) are not read");
  }
  // It also calls itself once a level, until the stack ends.
  if (deepestNesting(text) > kDeepest) throw std::runtime_error(path + ": is nested too deep");
  yaml node;
  const std::string whole = withLastKey(text);
  try {
    node.loadFromText(whole);
  } catch (const std::exception&) {
    const std::string key = keyWithoutValue(text);
    throw std::runtime_error(path + (key.empty() ? "" : ": " + key) +
                             (key.empty() ? ": is not valid YAML" : ": has no value"));
  }
  if (node.isNullNode() || !node.isMap()) {
    throw std::runtime_error(path + ": holds no 'key: value' lines");
  }
  if (whole != text && !node.has(kLastKey)) throw std::runtime_error(path + ": is not valid YAML");
  refuseRepeatedKeys(path, whole, node.node());
  auto entries = node.asMap();
  entries.erase(yaml::node_t(kLastKey));
  return YamlNode(path, std::move(entries));
}

void YamlNode::fail(const std::string& key, const std::string& complaint) const {
  throw std::runtime_error(where_ + ": " + key + ": " + complaint);
}

const YamlNode::Node* YamlNode::find(const std::string& key) const {
  for (const auto& [name, value] : entries_) {
    if (name.as<std::string>() == key) return &value;
  }
  return nullptr;
}

bool YamlNode::has(const std::string& key) const { return find(key) != nullptr; }

std::vector<std::string> YamlNode::keys() const {
  std::vector<std::string> all;
  for (const auto& entry : entries_) all.push_back(entry.first.as<std::string>());
  return all;
}

const YamlNode::Node& YamlNode::at(const std::string& key) const {
  const Node* value = find(key);
  if (!value) fail(key, "is missing");
  return *value;
}

double YamlNode::toNumber(const std::string& key, const Node& value) const {
  if (!value.isScalar()) fail(key, "must be a number");
  const std::string text = value.as<std::string>();
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(number)) {
    fail(key, "'" + text + "' is not a number");
  }
  return number;
}

double YamlNode::number(const std::string& key, double lowest, double highest) const {
  const double value = toNumber(key, at(key));
  if (value < lowest || value > highest) {
    fail(key,
         shown(value) + " is out of range, allowed is " + shown(lowest) + " to " + shown(highest));
  }
  return value;
}

double YamlNode::number(const std::string& key, double lowest, double highest,
                        double otherwise) const {
  return has(key) ? number(key, lowest, highest) : otherwise;
}

std::string YamlNode::text(const std::string& key) const {
  const Node& value = at(key);
  if (!value.isScalar() || value.as<std::string>().empty()) fail(key, "must be a text");
  return value.as<std::string>();
}

std::string YamlNode::choice(const std::string& key, const std::vector<std::string>& allowed,
                             const std::string& otherwise) const {
  if (!has(key)) return otherwise;
  const std::string value = text(key);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    fail(key, "'" + value + "' is not one of: " + joined(allowed));
  }
  return value;
}

std::vector<double> YamlNode::numbers(const std::string& key, std::size_t size) const {
  const Node& value = at(key);
  if (!value.isSequence() || (size > 0 && value.asSequence().size() != size)) {
    fail(key, "must be a list of " + (size > 0 ? std::to_string(size) + " " : "") + "numbers");
  }
  std::vector<double> all;
  for (const auto& entry : value.asSequence()) all.push_back(toNumber(key, entry));
  return all;
}

std::vector<std::vector<double>> YamlNode::rows(const std::string& key, std::size_t size) const {
  const Node& value = at(key);
  const std::string wanted = "must be a list of lists of " + std::to_string(size) + " numbers";
  if (!value.isSequence()) fail(key, wanted);
  std::vector<std::vector<double>> all;
  for (const auto& row : value.asSequence()) {
    if (!row.isSequence() || row.asSequence().size() != size) fail(key, wanted);
    all.emplace_back();
    for (const auto& entry : row.asSequence()) all.back().push_back(toNumber(key, entry));
  }
  return all;
}

std::vector<YamlNode> YamlNode::list(const std::string& key) const {
  if (!has(key)) return {};
  const Node& value = at(key);
  if (!value.isSequence()) fail(key, "must be a list");
  std::vector<YamlNode> all;
  for (const auto& entry : value.asSequence()) {
    const std::string place = key + "[" + std::to_string(all.size()) + "]";
    if (!entry.isMap()) fail(place, "must hold 'key: value' lines");
    all.push_back(YamlNode(where_ + ": " + place, entry.asMap()));
  }
  return all;
}

void YamlNode::allowOnly(const std::vector<std::string>& allowed) const {
  for (const auto& key : keys()) {
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      fail(key, "is no known key, allowed are: " + joined(allowed));
    }
  }
}

}  // namespace cca
