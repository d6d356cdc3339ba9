// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace cca {

/// Text without the mark that spreadsheets, and some editors, put before UTF-8.
inline std::string_view withoutMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

}  // namespace cca
