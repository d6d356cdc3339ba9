// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/parameters.hpp"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/system/filesystem.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <set>
#include <stdexcept>

namespace cca {
namespace {

std::string numberText(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string numberText(int value) { return std::to_string(value); }

[[noreturn]] void refuse(const std::string& text, const std::string& allowed) {
  throw std::runtime_error("'" + text + "' must be " + allowed);
}

/// Overloads for what describe() hands over; each appends one field to the list.
class FieldLister {
 public:
  FieldLister(const char* section, std::vector<ParameterField>& fields)
      : section_(section), fields_(fields) {}

  template <class Number>
  void operator()(const char* name, Number& value, Number lowest, Number highest, const char* unit,
                  const char* meaning) {
    const std::string kind = std::is_same_v<Number, int> ? "a whole number " : "a number ";
    const std::string allowed = kind + "in [" + numberText(lowest) + ", " + numberText(highest) +
                                "]" + (*unit ? std::string(" ") + unit : "");
    append(
        name, allowed, meaning, [&value] { return numberText(value); },
        [&value, lowest, highest, allowed](const std::string& text) {
          Number parsed{};
          const char* last = text.data() + text.size();
          const auto [end, error] = std::from_chars(text.data(), last, parsed);
          const bool in_range = parsed >= lowest && parsed <= highest;  // false for NaN
          if (error != std::errc() || end != last || !in_range) refuse(text, allowed);
          value = parsed;
        });
  }

  void operator()(const char* name, bool& value, const char* meaning) {
    append(
        name, "true or false", meaning, [&value] { return value ? "true" : "false"; },
        [&value](const std::string& text) {
          if (text != "true" && text != "false") refuse(text, "true or false");
          value = text == "true";
        });
  }

  void operator()(const char* name, std::string& value, std::initializer_list<const char*> choices,
                  const char* meaning) {
    std::string allowed = "one of";
    for (const char* choice : choices) allowed += std::string(" ") + choice;
    append(
        name, allowed, meaning, [&value] { return value; },
        [&value, allowed,
         known = std::set<std::string>(choices.begin(), choices.end())](const std::string& text) {
          if (!known.count(text)) refuse(text, allowed);
          value = text;
        });
  }

 private:
  void append(const char* name, std::string allowed, const char* meaning,
              std::function<std::string()> get, std::function<void(const std::string&)> set) {
    fields_.push_back(
        {section_, name, std::move(allowed), meaning, std::move(get), std::move(set)});
  }

  const char* section_;
  std::vector<ParameterField>& fields_;
};

}  // namespace

std::vector<ParameterField> listParameters(Parameters& p) {
  std::vector<ParameterField> fields;
  describeSections(p, [&fields](const char* section, auto& module) {
    describe(module, FieldLister(section, fields));
  });
  return fields;
}

namespace {

mrpt::config::CConfigFile openIni(const std::string& path) {
  try {
    return mrpt::config::CConfigFile(path);
  } catch (const std::exception& error) {
    // MRPT's message is several lines with a call stack; one begins with the number of the line.
    const std::string text = error.what();
    const std::size_t at = std::min(text.find("Line "), text.size());
    throw std::runtime_error(
        path + ": cannot be read as an .ini file: " + text.substr(at, text.find('\n', at) - at));
  }
}

}  // namespace

void loadParameters(const std::string& ini_path, Parameters& p) {
  if (!mrpt::system::fileExists(ini_path) || mrpt::system::directoryExists(ini_path)) {
    throw std::runtime_error(ini_path + ": no such file");
  }
  const mrpt::config::CConfigFile ini = openIni(ini_path);
  Parameters changed = p;
  const auto fields = listParameters(changed);
  std::vector<std::string> sections, keys;
  ini.getAllSections(sections);
  for (const auto& section : sections) {
    ini.getAllKeys(section, keys);
    if (section.empty() && keys.empty()) continue;
    const bool known = std::any_of(fields.begin(), fields.end(),
                                   [&](const auto& field) { return field.section == section; });
    if (!known && !section.empty()) {
      throw std::runtime_error(ini_path + ": [" + section +
                               "]: unknown section (see --dump-config)");
    }
    std::set<std::string> seen;
    for (const auto& key : keys) {
      const std::string where = ini_path + ": [" + section + "] " + key;
      if (!seen.insert(key).second) throw std::runtime_error(where + ": given twice");
      const ParameterField* field = nullptr;
      for (const auto& f : fields) {
        if (f.section == section && f.name == key) field = &f;
      }
      if (!field) throw std::runtime_error(where + ": unknown key (see --dump-config)");
      try {
        field->set(ini.read_string(section, key, ""));
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(where + " = " + error.what());
      }
    }
  }
  p = changed;
}

std::string dumpParameters(const Parameters& p) {
  Parameters copy = p;
  std::string text, section;
  for (const auto& field : listParameters(copy)) {
    if (field.section != section) {
      section = field.section;
      text += (text.empty() ? "[" : "\n[") + section + "]\n";
    }
    text += "# " + field.meaning + "; " + field.allowed + "\n";
    text += field.name + " = " + field.get() + "\n";
  }
  return text;
}

}  // namespace cca
