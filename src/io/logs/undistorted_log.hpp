// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// openUndistortedLog() of a log that somebody else opens, from the beginning each time.
/// @param sweep  s, of a scan; nothing: a first pass over the log finds it.
std::unique_ptr<LogReader> undistortedLog(const std::function<std::unique_ptr<LogReader>()>& open,
                                          const std::optional<double>& sweep);

}  // namespace cca
