// SPDX-License-Identifier: BSD-3-Clause
#include "private_parameters.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "ros/input/transforms.hpp"

namespace cca {
namespace {

/// As one would write it in an .ini file.
std::string textOf(XmlRpc::XmlRpcValue value) {
  using XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    case XmlRpcValue::TypeDouble: {
      char text[32];
      return {text, std::to_chars(text, text + sizeof text, static_cast<double>(value)).ptr};
    }
    default:
      return value.toXml();
  }
}

/// Of `[a, b]` or `a`.
std::vector<std::string> namesIn(std::string text) {
  const auto trim = [](std::string& word) {
    constexpr const char* kAround = " '\"";  // as YAML and shells leave them
    word.erase(0, word.find_first_not_of(kAround));
    word.erase(word.find_last_not_of(kAround) + 1);
  };
  trim(text);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') {
    text = text.substr(1, text.size() - 2);
  }
  std::vector<std::string> names(1);
  for (const char c : text) {
    if (c == ',') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  for (std::string& name : names) trim(name);
  return names;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

void PrivateParameters::refuse(const std::string& name, const std::string& value,
                               const std::string& allowed) const {
  throw std::runtime_error("parameter " + node_.resolveName(name) + " = '" + value + "' must be " +
                           allowed);
}

std::optional<std::string> PrivateParameters::given(const std::string& name) {
  known_.push_back(name);
  XmlRpc::XmlRpcValue value;
  if (!node_.getParam(name, value)) return std::nullopt;
  return textOf(value);
}

void PrivateParameters::text(const std::string& name, std::string& value) {
  value = given(name).value_or(value);
}

void PrivateParameters::path(const std::string& name, std::string& value, const std::string& what) {
  text(name, value);
  if (value.empty()) refuse(name, value, what);
}

void PrivateParameters::frame(const std::string& name, std::string& value,
                              const std::string& other) {
  std::string given = value;
  text(name, given);
  value = frameName(given);
  if (value.empty() || value.find(' ') != std::string::npos) refuse(name, given, "a frame of tf");
  if (value == other)
    refuse(name, given, "another frame: this node tells where one is in the other");
}

void PrivateParameters::topic(const std::string& name, std::string& value) {
  text(name, value);
  std::string why;
  if (!ros::names::validate(value, why)) refuse(name, value, "a topic: " + why);
}

void PrivateParameters::flag(const std::string& name, bool& value) {
  const std::optional<std::string> told = given(name);
  if (!told) return;
  if (*told != "true" && *told != "false") refuse(name, *told, "true or false");
  value = *told == "true";
}

template <class Number>
void PrivateParameters::number(const std::string& name, Number& value, Number lowest,
                               Number highest, const std::string& unit) {
  const std::optional<std::string> told = given(name);
  if (!told) return;
  const std::string& text = *told;
  const char* last = text.data() + text.size();
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (error != std::errc() || end != last || !(number >= lowest && number <= highest)) {
    std::ostringstream allowed;
    allowed << (std::is_integral_v<Number> ? "a whole number" : "a number") << " in [" << lowest
            << ", " << highest << "]" << (unit.empty() ? "" : " ") << unit;
    refuse(name, text, allowed.str());
  }
  value = number;
}

template void PrivateParameters::number(const std::string&, double&, double, double,
                                        const std::string&);
template void PrivateParameters::number(const std::string&, int&, int, int, const std::string&);

void PrivateParameters::choice(const std::string& name, std::string& value,
                               const std::vector<std::string>& allowed) {
  std::string chosen = value, list = "one of";
  text(name, chosen);
  for (const auto& word : allowed) list += " " + word;
  if (!contains(allowed, chosen)) refuse(name, chosen, list);
  value = chosen;
}

void PrivateParameters::names(const std::string& name, std::vector<std::string>& value) {
  known_.push_back(name);
  XmlRpc::XmlRpcValue parameter;
  if (!node_.getParam(name, parameter)) return;
  std::vector<std::string> chosen;
  if (parameter.getType() == XmlRpc::XmlRpcValue::TypeArray) {
    for (int k = 0; k < parameter.size(); ++k) chosen.push_back(textOf(parameter[k]));
  } else {
    chosen = namesIn(textOf(parameter));
  }
  std::string why;
  const std::set<std::string> different(chosen.begin(), chosen.end());
  const bool is_sound = !chosen.empty() && different.size() == chosen.size() &&
                        std::all_of(chosen.begin(), chosen.end(), [&why](const std::string& word) {
                          return !word.empty() && ros::names::validate(word, why);
                        });
  if (!is_sound) refuse(name, textOf(parameter), "a list of different topics, [a, b]");
  value = chosen;
}

void PrivateParameters::withoutEffect(const std::string& name) {
  unused_.push_back(name);
  if (node_.hasParam(name)) {
    ROS_WARN("parameter %s has no effect in this node", node_.resolveName(name).c_str());
  }
}

void PrivateParameters::program(Parameters& p, const std::vector<std::string>& sections) {
  std::string config;
  text("config", config);
  if (!config.empty()) loadParameters(config, p);
  const auto fields = listParameters(p);
  auto own = known_;  // the node's: `pose` is its own, and the program's is run/pose
  own.insert(own.end(), unused_.begin(), unused_.end());
  const auto set = [&](const ParameterField& field, const std::string& name) {
    if (!contains(sections, field.section)) return withoutEffect(name);
    const std::optional<std::string> text = given(name);
    try {
      if (text) field.set(*text);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("parameter " + node_.resolveName(name) + " = " + error.what());
    }
  };
  for (const auto& field : fields) {
    const auto namesakes = std::count_if(fields.begin(), fields.end(), [&field](const auto& other) {
      return other.name == field.name;
    });
    if (namesakes == 1 && !contains(own, field.name)) set(field, field.name);
    set(field, field.section + "/" + field.name);
  }
}

void PrivateParameters::refuseUnknown() const {
  for (const auto& [from, to] : ros::names::getUnresolvedRemappings()) {
    if (!contains(known_, from) && !contains(unused_, from)) continue;
    ROS_WARN("%s:=%s gives a topic another name; the parameter is given as _%s:=%s", from.c_str(),
             to.c_str(), from.c_str(), to.c_str());
  }
  std::vector<std::string> names;
  if (!node_.getParamNames(names)) return;
  const std::string prefix = node_.getNamespace() + "/";
  for (const auto& name : names) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string own = name.substr(prefix.size());
    if (own == "diagnostic_period") continue;  // diagnostic_updater's
    if (contains(known_, own) || contains(unused_, own)) continue;
    std::string list;
    for (const auto& known : known_) list += (list.empty() ? "" : " ") + known;
    throw std::runtime_error("parameter " + name + " is unknown; known are: " + list);
  }
}

}  // namespace cca
