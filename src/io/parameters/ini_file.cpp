// SPDX-License-Identifier: BSD-3-Clause
#include "ini_file.hpp"

#include <mrpt/config/config_parser.h>
#include <mrpt/system/string_utils.h>

#include <map>
#include <sstream>
#include <stdexcept>

#include "io/files/text.hpp"

namespace cca {
namespace {

using mrpt::system::trim;

/// With '\n' behind every line; editors end them by one of "\n", "\r\n", "\r", and may begin the
/// file with a byte order mark.
std::string readText(const std::string& path) {
  const std::string bytes = contentOf(path);
  std::string text;
  for (std::size_t i = bytes.size() - withoutMark(bytes).size(); i < bytes.size(); ++i) {
    const bool ends_with_the_next = bytes[i] == '\r' && bytes[i + 1] == '\n';
    if (!ends_with_the_next) text += bytes[i] == '\r' ? '\n' : bytes[i];
  }
  return text + "\n";
}

std::string withFormulasReplaced(const std::string& path, const std::string& text) {
  try {
    return mrpt::config::config_parser(text);
  } catch (const std::exception& error) {
    // MRPT's message may be several lines with a call stack; one begins with the number of the
    // line.
    const std::string message = error.what();
    const std::size_t at = std::min(message.find("Line "), message.size());
    throw std::runtime_error(path + ": cannot be read as an .ini file: " +
                             message.substr(at, message.find('\n', at) - at));
  }
}

/// The numbers of the lines of a text that are left where a backslash at the end joins two.
std::vector<int> numbersOfJoinedLines(const std::string& text) {
  std::vector<int> numbers{1};
  int number = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n') continue;
    ++number;
    if (i == 0 || text[i - 1] != '\\') numbers.push_back(number);
  }
  return numbers;
}

bool begins(const std::string& line, const char* with) { return line.rfind(with, 0) == 0; }

bool saysNothing(const std::string& line) {
  return line.empty() || begins(line, "#") || begins(line, ";") || begins(line, "//");
}

/// Splits a line into what it holds. @return whether it is one of an .ini file.
bool take(const std::string& line, IniLine& taken) {
  taken.key.clear();
  if (begins(line, "[")) {
    const std::size_t end = line.find(']');
    if (end == std::string::npos || !saysNothing(trim(line.substr(end + 1)))) return false;
    taken.section = trim(line.substr(1, end - 1));
    return true;
  }
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) return false;
  taken.key = trim(line.substr(0, equals));
  const std::string value = line.substr(equals + 1);
  taken.value = trim(value.substr(0, value.find(" //")));
  return !taken.key.empty() && line.find('\0') == std::string::npos;
}

}  // namespace

std::vector<IniLine> readIniFile(const std::string& path) {
  const std::string text = readText(path);
  const std::vector<int> numbers = numbersOfJoinedLines(text);
  std::istringstream rows(withFormulasReplaced(path, text));
  std::vector<IniLine> lines;
  std::map<std::string, int> number_of_key;
  IniLine line;
  std::string row;
  for (std::size_t k = 0; std::getline(rows, row); ++k) {
    line.number = numbers[std::min(k, numbers.size() - 1)];
    row = trim(row);
    if (saysNothing(row)) continue;
    const auto fail = [&](const std::string& complaint) {
      throw std::runtime_error(path + ": line " + std::to_string(line.number) + ": " + complaint);
    };
    if (!take(row, line)) fail("must be [section], key = value or a comment");
    if (!line.key.empty()) {
      const auto [known, is_new] = number_of_key.emplace(line.place(), line.number);
      if (!is_new) {
        fail(line.place() + ": is given twice, first in line " + std::to_string(known->second));
      }
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace cca
