// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// The file of true poses that simulators leave beside a log, rows `time x y theta` or
/// `index x y theta`: LOG.GT.txt or STEM_GT.txt. Nothing where there is none.
std::optional<std::string> findTruthFile(const std::string& log_path);

/// The same log with `truth` set: by time, interpolated, where the first column holds times;
/// by number of the scan where it counts 0, 1, 2, ... Scans outside the file's times get none.
/// A truth file that cannot be read is named in the warnings, and does no other harm.
std::unique_ptr<LogReader> withTruth(std::unique_ptr<LogReader> log, const std::string& truth_path);

}  // namespace cca
