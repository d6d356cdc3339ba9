// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// The rule that a line of a log breaks, for people: "ranges: 181 are needed, 12 are there".
class MalformedLine : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A kind of text log that has at most one scan in a line.
class LineFormat {
 public:
  virtual ~LineFormat() = default;
  /// The scan of the next line of a log; nothing where it holds none (a header, a comment).
  /// @throws MalformedLine  where it should hold one; a line after it can be read all the same.
  virtual std::optional<LogRecord> parse(std::string_view line) = 0;
};

/// Reads such a log, plain or gzipped. Its missing returns are judged (see MissingReturns). Lines
/// after the first scan that are malformed are left out, with a warning that names the first.
/// @throws std::runtime_error  where it cannot be read, holds no scan, or where its header or its
///         first scan is malformed: names file, line and the rule.
std::unique_ptr<LogReader> openLineLog(const std::string& path, std::unique_ptr<LineFormat> format);

/// Requires that beams lie within one turn. @throws MalformedLine naming the angles.
void requireOneTurn(const Scan& scan);

}  // namespace cca
