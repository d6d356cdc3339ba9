// SPDX-License-Identifier: BSD-3-Clause
#include "serve_options.hpp"

#include <cstdio>

namespace cca::apps {

std::shared_ptr<const ServeOptions> addServeOptions(CLI::App& command) {
  auto options = std::make_shared<ServeOptions>();
  command
      .add_option("--serve", options->port,
                  "show the run in browsers as it goes, at this port of this machine; 0: any free")
      ->type_name("[PORT]")
      ->expected(0, 1)
      ->default_str(std::to_string(LivePageSettings::kPort))
      ->check(CLI::Range(0, 65535));
  command
      .add_option(
          "--serve-address", options->address,
          "serve at another address of this machine: who asks must know a random token then")
      ->type_name("ADDR")
      ->check(CLI::ValidIPV4)
      ->needs("--serve");
  return options;
}

std::unique_ptr<LivePage> serve(const ServeOptions& options, LivePageSettings settings) {
  if (options.port < 0) return nullptr;
  settings.address = options.address;
  settings.port = options.port;
  auto page = openLivePage(settings);
  std::fprintf(stderr, "cca-mrpt: the run can be seen at %s\n", page->url().c_str());
  return page;
}

}  // namespace cca::apps
