// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/options/parameter_options.hpp"
#include "cca_mrpt/simulation/world_generator.hpp"
#include "commands.hpp"
#include "io/maps/world_files.hpp"

namespace cca::apps {

namespace {

struct GenerateOptions {
  std::string kind, name, out = ".";
  std::uint64_t seed = 1;
  bool force = false;
};

void generate(const GenerateOptions& options) {
  Building plan = generateBuilding(options.kind, options.seed);
  if (!options.name.empty()) plan.name = options.name;
  const std::string stem = options.out + "/" + plan.name, path = stem + ".yaml";
  for (const char* ending : {".yaml", ".png", ".truth.csv"}) {
    if (!options.force && std::filesystem::exists(stem + ending))
      throw std::runtime_error(stem + ending + ": exists; --force overwrites it");
  }
  writeWorldFiles(plan, options.out);
  std::printf("%s\n", path.c_str());
}

}  // namespace

void addGenerateWorldCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "generate-world", "a world with its true walls, by kind and seed, as in maps/");
  auto options = std::make_shared<GenerateOptions>();
  command->add_option("KIND", options->kind, "kind of building")
      ->required()
      ->check(CLI::IsMember(buildingKinds()));
  command->add_option("--seed", options->seed, "varies furniture and random buildings")
      ->check(valueOf("run.seed"))
      ->capture_default_str();
  command->add_option("--name", options->name, "name of the files, if not KIND");
  command->add_option("--out", options->out, "folder")->capture_default_str();
  command->add_flag("--force", options->force, "overwrite a world of that name");
  command->callback([options] { generate(*options); });
}

}  // namespace cca::apps
