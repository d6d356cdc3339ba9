// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// Reads a log in a process of its own, one or a few scans ahead. The libraries that read MRPT's
/// files and bags believe what a damaged file says: there they end that process or run into its
/// limit of memory, and here the log ends with a warning.
///
/// @param open  opens the log; called in the other process, and what it throws is thrown here.
/// @throws std::runtime_error also where there can be no other process.
std::unique_ptr<LogReader> readInChild(const std::string& path,
                                       const std::function<std::unique_ptr<LogReader>()>& open);

}  // namespace cca
