// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <string>
#include <utility>

namespace cca::python {

namespace nb = nanobind;

/// Sets described parameters from keyword arguments, each of which it takes out of them.
class KeywordReader {
 public:
  explicit KeywordReader(nb::kwargs& keywords) : keywords_(keywords) {}

  template <class Number>
  void operator()(const char* name, Number& value, Number lowest, Number highest, const char* unit,
                  const char*) {
    Number given{};
    if (!take(name, given, std::is_same_v<Number, int> ? "a whole number" : "a number")) return;
    if (!(given >= lowest && given <= highest)) {
      const nb::str text =
          nb::str("{}: {} is not in [{}, {}] {}").format(name, given, lowest, highest, unit);
      throw nb::value_error(text.c_str());
    }
    value = given;
  }
  void operator()(const char* name, bool& value, const char*) { take(name, value, "a bool"); }
  template <class Choice, std::size_t N>
  void operator()(const char* name, Choice& value, const std::pair<const char*, Choice> (&names)[N],
                  const char*) {
    std::string given;
    if (!take(name, given, "a string")) return;
    std::string known;
    for (const auto& [word, choice] : names) {
      if (given == word) return void(value = choice);
      known += std::string(" ") + word;
    }
    throw nb::value_error((std::string(name) + ": '" + given + "' is none of" + known).c_str());
  }

  /// @throws nb::value_error naming a keyword that nothing has taken.
  void refuseRest() const {
    for (const auto [name, value] : keywords_) {
      throw nb::value_error((std::string(nb::str(name).c_str()) + ": no such parameter").c_str());
    }
  }

 private:
  template <class Value>
  bool take(const char* name, Value& value, const char* kind) {
    if (!keywords_.contains(name)) return false;
    const nb::object given = keywords_[name];
    if (!nb::try_cast<Value>(given, value)) {
      const nb::str text = nb::str("{}: {} is needed, not {!r}").format(name, kind, given);
      throw nb::value_error(text.c_str());
    }
    nb::del(keywords_[name]);
    return true;
  }

  nb::kwargs& keywords_;
};

/// Parameters from the keyword arguments of a call. @throws nb::value_error naming the argument.
template <class... Parameters>
void readParameters(nb::kwargs& keywords, Parameters&... parameters) {
  KeywordReader reader(keywords);
  (describe(parameters, reader), ...);
  reader.refuseRest();
}

/// Writes a line on each described parameter: name, meaning, default, range, unit.
class ParameterList {
 public:
  template <class Number>
  void operator()(const char* name, Number& value, Number lowest, Number highest, const char* unit,
                  const char* meaning) {
    add(name, meaning, nb::str("{}, in [{}, {}] {}").format(value, lowest, highest, unit).c_str());
  }
  void operator()(const char* name, bool& value, const char* meaning) {
    add(name, meaning, value ? "True" : "False");
  }
  template <class Choice, std::size_t N>
  void operator()(const char* name, Choice& value, const std::pair<const char*, Choice> (&names)[N],
                  const char* meaning) {
    std::string preset, known;
    for (const auto& [word, choice] : names) {
      if (choice == value) preset = word;
      known += std::string(known.empty() ? "" : ", ") + word;
    }
    add(name, meaning, "'" + preset + "', one of " + known);
  }
  const std::string& text() const { return text_; }

 private:
  void add(const char* name, const char* meaning, const std::string& values) {
    text_ += std::string("    ") + name + ": " + meaning + " (default " + values + ")\n";
  }
  std::string text_ = "\n\nKeyword parameters:\n";
};

/// Writes each described parameter as a keyword argument of a signature: "name: type = default".
class ParameterSignature {
 public:
  template <class Number>
  void operator()(const char* name, Number& value, Number, Number, const char*, const char*) {
    add(name, std::is_same_v<Number, int> ? "int" : "float", nb::repr(nb::cast(value)).c_str());
  }
  void operator()(const char* name, bool& value, const char*) {
    add(name, "bool", value ? "True" : "False");
  }
  template <class Choice, std::size_t N>
  void operator()(const char* name, Choice& value, const std::pair<const char*, Choice> (&names)[N],
                  const char*) {
    std::string preset, known;
    for (const auto& [word, choice] : names) {
      const std::string quoted = std::string("'") + word + "'";
      if (choice == value) preset = quoted;
      known += (known.empty() ? "" : ", ") + quoted;
    }
    add(name, "typing.Literal[" + known + "]", preset);
  }
  const std::string& text() const { return text_; }

 private:
  void add(const char* name, const std::string& type, const std::string& preset) {
    text_ += std::string(text_.empty() ? "*, " : ", ") + name + ": " + type + " = " + preset;
  }
  std::string text_;
};

/// "def HEAD, *, name: type = default, ...) -> RESULT", by the described parameters.
template <class... Parameters>
std::string parameterSignature(const char* head, const char* result) {
  ParameterSignature list;
  const auto append = [&list](auto parameters) { describe(parameters, list); };
  (append(Parameters{}), ...);
  return std::string("def ") + head + ", " + list.text() + ") -> " + result;
}

template <class... Parameters>
std::string parameterDocs(const char* docs) {
  ParameterList list;
  const auto append = [&list](auto parameters) { describe(parameters, list); };
  (append(Parameters{}), ...);
  return docs + list.text();
}

}  // namespace cca::python
