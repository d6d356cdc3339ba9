// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cca {

/// What printf() would print.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

/// The bytes of a file. @throws std::runtime_error naming the file where it cannot be read.
std::string contentOf(const std::string& path);

/// Text without the mark that spreadsheets, and some editors, put before UTF-8.
std::string_view withoutMark(std::string_view text);

/// Text without blanks, tabs and carriage returns about it.
std::string_view withoutBlanks(std::string_view text);

/// A number as programs write it, also nan, inf and a leading plus; 0 where it is too small or too
/// large for a double; nothing where it is none.
std::optional<double> numberOf(std::string_view text);

/// A row of a CSV of numbers, with commas between its fields: where semicolons part them, as
/// spreadsheets write it, a comma is a decimal point.
std::string byCommas(std::string row);

/// Appends a warning to others, separated by "; ". An empty one changes nothing.
void appendWarning(const std::string& warning, std::string& warnings);

}  // namespace cca
