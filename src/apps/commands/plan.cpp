// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "apps/options/origin_option.hpp"
#include "commands.hpp"
#include "io/files/text.hpp"
#include "io/plans/plan_files.hpp"
#include "io/plans/plan_formats.hpp"

namespace cca::apps {
namespace {

struct PlanCommandOptions {
  std::string map, out, labels;
  std::optional<GeoReference> place;
  bool force = false, quiet = false;
};

void tellPlan(const FloorPlan& plan, const std::string& out) {
  double area = 0.0, open_border = 0.0;
  int doors = 0;
  for (const PlanRoom& room : plan.rooms) {
    area += room.area;
    open_border += room.open_border;
  }
  for (const PlanOpening& opening : plan.openings) doors += opening.kind == OpeningKind::kDoor;
  std::printf("%zu rooms, %.1f m^2 of floor, %d doors, %zu other openings, %zu walls\n",
              plan.rooms.size(), area, doors,
              plan.openings.size() - static_cast<std::size_t>(doors), plan.walls.size());
  if (open_border > 0.02 * area) {
    std::printf("%.1f m of the rooms' borders are neither wall nor opening: the map ends there\n",
                open_border);
  }
  std::printf(
      "%s holds the plan: rooms.png to look at, plan.pdf to print, plan.dxf and others to use\n",
      out.c_str());
}

void plan(const PlanCommandOptions& options) {
  const std::string out = options.out.empty() ? options.map : options.out;
  RoomLabels labels;
  if (!options.labels.empty()) labels = roomLabelsOfFile(options.labels);
  FloorPlan found = planOfFolder(options.map);
  const RoomLabels outside = nameRooms(found, labels);
  writePlanFiles(out, planFiles(found, titleOfFolder(options.map), options.place), options.force);
  if (!options.quiet) tellPlan(found, out);
  for (const auto& [p, name] : outside) {
    std::fprintf(stderr, "cca-mrpt: %s: (%.6g, %.6g), %s, lies in no room\n",
                 options.labels.c_str(), p.x(), p.y(), name.c_str());
  }
  if (found.rooms.empty()) throw Shortcoming(options.map + ": no room was found in this map");
  if (!outside.empty())
    throw Shortcoming(std::to_string(outside.size()) + " labels lie in no room");
}

}  // namespace

void addPlanCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "plan", "floor plan of a finished map: rooms with areas, walls, doors, furniture");
  auto options = std::make_shared<PlanCommandOptions>();
  command
      ->add_option("DIR", options->map,
                   "folder that map, explore or merge left (its lines.csv, map.yaml and map.pgm)")
      ->required();
  command->add_option("--out", options->out, "folder to write the plan to; DIR where not given");
  command->add_option("--labels", options->labels,
                      "CSV with columns x, y (m, map frame) and name: names the rooms");
  addOriginOption(*command, options->place, "plan.geojson is");
  command->add_flag("--force", options->force, "overwrite a plan that is there");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  command->callback([options] { plan(*options); });
}

}  // namespace cca::apps
