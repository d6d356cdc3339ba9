// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/logs/judged_map.hpp"
#include "apps/logs/log_warnings.hpp"
#include "apps/options/world_name.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text.hpp"
#include "io/lines/segments_csv.hpp"

namespace cca::apps {
namespace {

LogScore evaluateLog(const std::string& log, const JudgedMap& map) {
  const auto reader = openUndistortedLog(log);
  const LogScore score = judgeByLog(*reader, map);
  tellWarnings(log, reader->warnings());
  return score;
}

/// A world's name says which of ours it is where no true walls stand beside it.
LogScore evaluateWorld(const std::string& world, const JudgedMap& map) {
  const bool is_known = std::filesystem::exists(truthPath(world));
  return judgeByWorld(is_known ? world : findWorld(world), map);
}

}  // namespace

void addEvaluateCommand(CLI::App& program) {
  struct Options {
    std::string map, log, world, out;
    bool force = false;
  };
  auto* command = program.add_subcommand(
      "evaluate", "quality of a line map against the scans it was made from, or the true world");
  auto options = std::make_shared<Options>();
  command->add_option("MAP", options->map, "line map, CSV x1,y1,x2,y2,...")->required();
  auto* against = command->add_option_group("against");
  against->add_option("--log", options->log, "the laser log that the map was made from");
  against->add_option(
      "--world", options->world,
      "the world, a YAML file or the name of one of ours; NAME.truth.csv stands beside it");
  against->require_option(1);
  command->add_option("--out", options->out, "JSON file to write; default: standard output");
  command->add_flag("--force", options->force, "overwrite that file");
  command->callback([options] {
    requireNew(options->out, options->force);
    requireApart(options->out, {options->map, options->log, options->world});
    const JudgedMap map(contentOf(options->map), options->map);
    const LogScore score =
        options->log.empty() ? evaluateWorld(options->world, map) : evaluateLog(options->log, map);
    const std::string text = textOf(score);
    if (options->out.empty()) {
      std::fputs(text.c_str(), stdout);
    } else {
      writeFile(options->out, text);
    }
  });
}

}  // namespace cca::apps
