// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "live/live_page.hpp"

namespace cca::apps {

/// Whether and where a command serves the live page.
struct ServeOptions {
  std::string address = "127.0.0.1";
  int port = -1;  ///< -1: there is no page
};

/// Adds --serve and --serve-address.
std::shared_ptr<const ServeOptions> addServeOptions(CLI::App& command);

/// Opens the page and prints its address on stderr; null where nobody asked for one.
/// @param settings  of the run; the options say where.
std::unique_ptr<LivePage> serve(const ServeOptions& options, LivePageSettings settings);

}  // namespace cca::apps
