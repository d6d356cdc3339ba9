// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/memory_file.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "commands.hpp"
#include "on_all_cores.hpp"
#include "parameter_options.hpp"

namespace cca::apps {
namespace {

struct MergeOptions {
  std::vector<std::string> maps;
  std::string out;
  bool force = false, quiet = false;
};

/// Each map in the frame of the first; the parts of the others begin as they were.
Slam joined(const MergeOptions& options, const std::vector<StoredMemory>& stored) {
  Slam slam;
  std::vector<int> first_of;  // frame of each map
  for (const StoredMemory& map : stored) {
    first_of.push_back(slam.remembered());
    slam.remember(map.memory);
  }
  slam.finish(doOnAllCores);
  const std::vector<bool> is_placed = slam.isPlaced();
  for (std::size_t k = 1; k < stored.size(); ++k) {
    if (is_placed[static_cast<std::size_t>(first_of[k])]) continue;
    throw std::runtime_error(options.maps[k] + ": no place of it was found in " +
                             options.maps.front() + "; nothing was written");
  }
  return slam;
}

MapProducts productsOf(const Slam& slam, const Eigen::Vector2d& origin, const MergeOptions& options,
                       const Parameters& parameters) {
  MapProducts products;
  const SlamMemory memory = slam.memory();
  LineMap map(parameters.mapping);
  ScanGrid grid(memory.graph.size() > 0 ? memory.graph.pose(0).position()
                                        : Eigen::Vector2d(Eigen::Vector2d::Zero()));
  for (int k = 0; k < memory.graph.size(); ++k) {
    Scan scan = memory.scans[static_cast<std::size_t>(k)].scan;
    scan.T_map_sensor = memory.graph.pose(k);
    map.insert(scan);
    grid.insert(scan);
  }
  products.title = std::filesystem::path(options.out).filename().string();
  products.lines = map.lines();
  products.poly_lines = map.polyLines();
  products.arcs = map.arcs();
  products.grid = grid.grid();
  products.origin = origin;
  products.graph = memory.graph;
  products.memory = packedMemory({memory, origin});
  products.summary["program"] = "cca-mrpt " CCA_VERSION;
  products.summary["maps"] = options.maps;
  products.summary["finished"] = true;
  products.summary["key_frames"] = memory.graph.size();
  products.summary["loops"] = slam.loops().size();
  products.summary["parameters"] = parametersJson(parameters, {"mapping"});
  return products;
}

void merge(const MergeOptions& options, const Parameters& parameters) {
  std::vector<StoredMemory> stored;
  for (const std::string& map : options.maps) stored.push_back(loadMemory(map));
  const Slam slam = joined(options, stored);
  const FolderLock folder = prepareMapFolder(options.out, options.force);
  const MapProducts products = productsOf(slam, stored.front().origin, options, parameters);
  writeMapFolder(options.out, products);
  if (options.quiet) return;
  std::printf("%zu lines from %zu maps, %d key frames, %zu loops between and within them\n",
              products.lines.size(), options.maps.size(), products.graph.size(),
              slam.loops().size());
  std::printf("%s holds the map: map.png to look at, lines.csv and others to use\n",
              options.out.c_str());
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
