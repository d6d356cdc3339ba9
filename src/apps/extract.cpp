// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "commands.hpp"
#include "parameter_options.hpp"

namespace cca::apps {

void addExtractCommand(CLI::App& program) {
  auto* command = program.add_subcommand("extract", "lines of each single scan, sensor frame");
  auto log = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  command->add_option("LOG", *log, "laser log")->required();
  command->add_option("--out", *out, "CSV file to write")->required();
  auto options = std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  command->callback([log, out, options] {
    const Parameters parameters = options->resolve();
    auto reader = openLog(*log);
    std::FILE* file = std::fopen(out->c_str(), "w");
    if (!file) throw std::runtime_error(*out + ": cannot be written");
    std::fprintf(file, "scan_id,x1,y1,x2,y2\n");
    for (int id = 0; auto record = reader->next(); ++id) {
      for (const auto& line : extractLines(record->scan, parameters.mapping)) {
        std::fprintf(file, "%d,%.6f,%.6f,%.6f,%.6f\n", id, line.start.x(), line.start.y(),
                     line.end.x(), line.end.y());
      }
    }
    std::fclose(file);
  });
}

}  // namespace cca::apps
