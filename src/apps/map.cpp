// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <string>

#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/line_texts.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "commands.hpp"
#include "parameter_options.hpp"

namespace cca::apps {

void addMapCommand(CLI::App& program) {
  auto* command = program.add_subcommand("map", "line map of a whole log");
  auto log = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  command->add_option("LOG", *log, "laser log")->required();
  command->add_option("--out", *out, "folder to write the map to")->required();
  auto options = std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  command->callback([log, out, options] {
    const Parameters parameters = options->resolve();
    auto reader = openLog(*log);
    LineMap map(parameters.mapping);
    while (const auto record = reader->next()) map.insert(record->scan);
    map.finishBatch();
    std::filesystem::create_directories(*out);
    writeFile(*out + "/lines.csv", linesCsv(map.lines()));
  });
}

}  // namespace cca::apps
