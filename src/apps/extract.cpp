// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "commands.hpp"
#include "log_warnings.hpp"
#include "parameter_options.hpp"

namespace cca::apps {

namespace {

constexpr char kHeader[] = "scan_id,x1,y1,x2,y2,returns,sigma_lateral,sigma_angle\n";

std::string row(int scan_id, const LineSegment& line) {
  std::array<char, 256> text{};
  const int length =
      std::snprintf(text.data(), text.size(), "%d,%.6f,%.6f,%.6f,%.6f,%.0f,%.6f,%.6f\n", scan_id,
                    line.start.x(), line.start.y(), line.end.x(), line.end.y(), line.moments.weight,
                    std::sqrt(line.covariance(0, 0)), std::sqrt(line.covariance(1, 1)));
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace

void addExtractCommand(CLI::App& program) {
  auto* command = program.add_subcommand("extract", "lines of each single scan, sensor frame");
  auto log = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  auto force = std::make_shared<bool>(false);
  command->add_option("LOG", *log, "laser log")->required();
  command->add_option("--out", *out, "CSV file to write")->required();
  command->add_flag("--force", *force, "overwrite a file that is there");
  auto options = std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  command->callback([log, out, force, options] {
    const Parameters parameters = options->resolve();
    if (!*force && std::filesystem::is_regular_file(*out)) {
      throw std::runtime_error(*out + ": is there already (--force overwrites it)");
    }
    auto reader = openLog(*log);
    std::string csv = kHeader;
    for (int id = 0; auto record = reader->next(); ++id) {
      for (const LineSegment& line : extractLines(record->scan, parameters.mapping)) {
        csv += row(id, line);
      }
    }
    tellWarnings(*log, reader->warnings());
    writeFile(*out, csv);
  });
}

}  // namespace cca::apps
