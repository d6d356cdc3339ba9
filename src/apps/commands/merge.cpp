// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/logs/contradiction.hpp"
#include "apps/options/parameter_options.hpp"
#include "apps/runs/on_all_cores.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "commands.hpp"
#include "io/files/memory_file.hpp"
#include "io/maps/grid_recorder.hpp"
#include "io/maps/map_folder.hpp"

namespace cca::apps {
namespace {

struct MergeOptions {
  std::vector<std::string> maps;
  std::string out;
  bool force = false, quiet = false;
};

/// Maps joined in the frame of the first.
struct Merged {
  explicit Merged(const CcaParameters& mapping) {
    auto localiser = std::make_unique<SlamLocaliser>();
    slam = localiser.get();
    MappingSession::Settings settings;
    settings.mapping = mapping;
    settings.maps_at_the_end = true;
    session = std::make_unique<MappingSession>(std::move(localiser), settings, &grid);
  }
  GridRecorder grid;
  SlamLocaliser* slam;
  std::unique_ptr<MappingSession> session;
};

void join(const MergeOptions& options, const std::vector<StoredMemory>& stored, Merged& merged) {
  std::vector<const SlamMemory*> drives;
  for (const StoredMemory& map : stored) drives.push_back(&map.memory);
  const auto apart = joinDrives(drives, *merged.slam, *merged.session, doOnAllCores);
  if (!apart) return;
  throw std::runtime_error(options.maps[*apart] + ": no place of it was found in " +
                           options.maps.front() + "; nothing was written");
}

MapProducts productsOf(const Merged& merged, const Eigen::Vector2d& origin,
                       const MergeOptions& options, const Parameters& parameters) {
  const std::string title = std::filesystem::path(options.out).filename().string();
  MapProducts products = mapProducts(title, *merged.session);
  const SlamMemory memory = merged.slam->slam().memory();
  products.grid = merged.grid.grid().raster();
  products.origin = origin;
  products.graph = memory.graph;
  products.memory = packedMemory({memory, origin});
  products.summary["program"] = "cca-mrpt " CCA_VERSION;
  products.summary["maps"] = options.maps;
  products.summary["finished"] = true;
  products.summary["key_frames"] = memory.graph.size();
  products.summary["loops"] = merged.slam->slam().loopsClosed();
  products.summary["parameters"] = parametersJson(parameters, {"mapping"});
  return products;
}

void merge(const MergeOptions& options, const Parameters& parameters) {
  std::vector<StoredMemory> stored;
  for (const std::string& map : options.maps) stored.push_back(loadMemory(map));
  Merged merged(parameters.mapping);
  join(options, stored, merged);
  const FolderLock folder = prepareMapFolder(options.out, options.force);
  const MapProducts products = productsOf(merged, stored.front().origin, options, parameters);
  writeMapFolder(options.out, products);
  if (!options.quiet) {
    std::printf("%zu lines from %zu maps, %d key frames, %zu loops between and within them\n",
                products.lines.size(), options.maps.size(), products.graph.size(),
                merged.slam->slam().loopsClosed());
    std::printf("%s holds the map: map.png to look at, lines.csv and others to use\n",
                options.out.c_str());
  }
  const std::string shortcoming = contradiction(merged.session->agreement());
  if (!shortcoming.empty()) throw Shortcoming(shortcoming + "; the map is in " + options.out);
}

}  // namespace

void addMergeCommand(CLI::App& program) {
  auto* command =
      program.add_subcommand("merge", "maps of one place, by one robot or several, become one");
  auto options = std::make_shared<MergeOptions>();
  command
      ->add_option("MAP", options->maps,
                   "folders that map or explore left (their map.slam); the first one's frame stays")
      ->required()
      ->expected(2, 1000);
  command->add_option("--out", options->out, "folder to write the map to")->required();
  command->add_flag("--force", options->force, "overwrite a map that is there");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  auto parameters =
      std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  command->callback([options, parameters] { merge(*options, parameters->resolve()); });
}

}  // namespace cca::apps
