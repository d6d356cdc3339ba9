// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "commands.hpp"
#include "parameter_options.hpp"

namespace cca::apps {

void addMapCommand(CLI::App& program) {
  auto* command = program.add_subcommand("map", "line map of a whole log");
  auto log = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  auto force = std::make_shared<bool>(false);
  command->add_option("LOG", *log, "laser log")->required();
  command->add_option("--out", *out, "folder to write the map to")->required();
  command->add_flag("--force", *force, "overwrite a map that is there");
  auto options = std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  command->callback([log, out, force, options] {
    const Parameters parameters = options->resolve();
    auto reader = openLog(*log);
    prepareMapFolder(*out, *force);
    MapProducts products;
    products.title = std::filesystem::path(*log).filename().string();
    LineMap map(parameters.mapping);
    ScanGrid grid;
    while (const auto record = reader->next()) {
      map.insert(record->scan);
      grid.insert(record->scan);
      products.trajectory.push_back(record->scan.T_map_sensor * record->T_robot_sensor.inverse());
    }
    map.finishBatch();
    products.lines = map.lines();
    products.poly_lines = map.polyLines();
    products.grid = grid.grid();
    writeMapFolder(*out, products);
  });
}

}  // namespace cca::apps
