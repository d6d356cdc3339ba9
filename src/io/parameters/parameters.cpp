// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/parameters.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <utility>

#include "ini_file.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

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

  template <class Choice, std::size_t N>
  void operator()(const char* name, Choice& value, const std::pair<const char*, Choice> (&names)[N],
                  const char* meaning) {
    std::string allowed = "one of";
    for (const auto& [word, choice] : names) allowed += std::string(" ") + word;
    append(
        name, allowed, meaning,
        [&value, &names] {
          for (const auto& [word, choice] : names) {
            if (choice == value) return word;
          }
          return "";
        },
        [&value, &names, allowed](const std::string& text) {
          for (const auto& [word, choice] : names) {
            if (text != word) continue;
            value = choice;
            return;
          }
          refuse(text, allowed);
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

void loadParameters(const std::string& ini_path, Parameters& p) {
  Parameters changed = p;
  const auto fields = listParameters(changed);
  for (const IniLine& line : readIniFile(ini_path)) {
    const std::string where = ini_path + ": " + line.place();
    if (line.key.empty()) {
      const bool known = std::any_of(fields.begin(), fields.end(), [&](const auto& field) {
        return field.section == line.section;
      });
      if (!known) throw std::runtime_error(where + ": unknown section (see --dump-config)");
      continue;
    }
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const auto& f) {
      return f.section == line.section && f.name == line.key;
    });
    if (field == fields.end()) {
      throw std::runtime_error(where + ": unknown key (see --dump-config)");
    }
    try {
      field->set(line.value);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(where + " = " + error.what());
    }
  }
  p = changed;
}

nlohmann::ordered_json parametersJson(const Parameters& p,
                                      const std::vector<std::string>& sections) {
  Parameters copy = p;
  Json json = Json::object();
  for (const auto& field : listParameters(copy)) {
    if (std::find(sections.begin(), sections.end(), field.section) == sections.end()) continue;
    const std::string text = field.get();
    const Json value = Json::parse(text, nullptr, false);
    json[field.section][field.name] = value.is_discarded() ? Json(text) : value;
  }
  return json;
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
