// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>

namespace cca::apps {

/// Accepts numbers in [lowest, highest]. CLI::Range takes NaN, too.
template <class Number>
CLI::Validator within(Number lowest, Number highest) {
  std::ostringstream range;
  range << "in [" << lowest << " - " << highest << "]";
  const auto check = [lowest, highest, allowed = range.str()](const std::string& text) {
    Number number{};
    const bool is_number = CLI::detail::lexical_cast(text, number);
    if (is_number && number >= lowest && number <= highest) return std::string();
    return text + " must be a number " + allowed;
  };
  return CLI::Validator(check, range.str());
}

}  // namespace cca::apps
