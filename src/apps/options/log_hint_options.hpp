// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca::apps {

/// --topic, --base-frame and --mount of a command that reads logs.
std::shared_ptr<const LogHints> addLogHintOptions(CLI::App& command);

}  // namespace cca::apps
