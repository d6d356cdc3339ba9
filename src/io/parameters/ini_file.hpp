// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace cca {

/// A line of an .ini file that says something.
struct IniLine {
  int number = 0;  ///< from 1
  std::string section;
  std::string key;  ///< empty: the line opens the section
  std::string value;

  /// "[section] key", or "[section]".
  std::string place() const { return "[" + section + "]" + (key.empty() ? "" : " " + key); }
};

/// The lines of an MRPT .ini file, of which none is passed over: `[section]`, `key = value`, MRPT's
/// `@define`, comments (`#`, `;`, `//`; behind a value ` //`) and empty ones. `${name}`,
/// `$env{NAME}` and `$eval{formula}` are replaced, a backslash at the end joins two lines.
/// @throws std::runtime_error naming the file where it cannot be read, and the line that is none of
///         these, or gives a key once more.
std::vector<IniLine> readIniFile(const std::string& path);

}  // namespace cca
