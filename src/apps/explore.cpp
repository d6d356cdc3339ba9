// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "commands.hpp"

namespace cca::apps {

namespace {

constexpr double kControlPeriod = 0.1;  // s

struct ExploreOptions {
  std::string world, out = "out";
  std::vector<double> start;  // x, y in m, heading in degrees
  double longest_time = 7200.0;
  CcaParameters mapping;
  ExplorerParameters explorer;
  SimulationParameters simulation;
};

std::FILE* openFile(const std::filesystem::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
  return file;
}

void writeResults(const ExploreOptions& options, const Simulation& simulation,
                  const Explorer& explorer, const Action& last) {
  const std::filesystem::path out(options.out);
  std::filesystem::create_directories(out);
  std::FILE* file = openFile(out / "trajectory.csv");
  std::fprintf(file, "t,x,y,theta\n");
  for (const auto& [t, T] : simulation.trajectory()) {
    std::fprintf(file, "%.3f,%.6f,%.6f,%.6f\n", t, T.x, T.y, T.theta);
  }
  std::fclose(file);
  const auto lines = explorer.lineMap().lines();
  file = openFile(out / "lines.csv");
  std::fprintf(file, "x1,y1,x2,y2\n");
  for (const auto& [id, segment, support] : lines) {
    std::fprintf(file, "%.6f,%.6f,%.6f,%.6f\n", segment.start.x(), segment.start.y(),
                 segment.end.x(), segment.end.y());
  }
  std::fclose(file);
  file = openFile(out / "summary.json");
  std::fprintf(file,
               "{\n  \"finished\": %s,\n  \"reason\": \"%s\",\n  \"distance_m\": %.3f,\n"
               "  \"duration_s\": %.3f,\n  \"collisions\": %d,\n  \"map_lines\": %zu\n}\n",
               last.status == ExplorationStatus::kFinished ? "true" : "false", last.reason.c_str(),
               simulation.distance(), simulation.time(), simulation.collisions(), lines.size());
  std::fclose(file);
}

void explore(const ExploreOptions& options) {
  World world = loadWorld(options.world);
  const double radius = options.simulation.robot.radius;
  const auto& start = options.start;
  const Pose2 T_map_start = start.empty()
                                ? defaultStart(world, radius)
                                : Pose2{start[0], start[1], wrapAngle(start[2] * M_PI / 180.0)};
  Simulation simulation(std::move(world), T_map_start, options.simulation);
  Explorer explorer(options.mapping, options.simulation.robot, options.explorer);
  Action action;
  while (simulation.time() < options.longest_time) {
    action = explorer.step(simulation.observe());
    if (action.status == ExplorationStatus::kFinished) break;
    simulation.drive(action.velocity, kControlPeriod);
  }
  writeResults(options, simulation, explorer, action);
}

}  // namespace

void addExploreCommand(CLI::App& program) {
  auto* command = program.add_subcommand("explore", "simulated exploration of a world");
  auto options = std::make_shared<ExploreOptions>();
  command->add_option("WORLD", options->world, "world, a map_server YAML file")->required();
  command->add_option("--out", options->out, "folder for the results");
  command->add_option("--start", options->start, "X,Y,DEG: start pose, m and degrees")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--strategy", options->explorer.strategy, "how goals are chosen");
  command->add_option("--seed", options->simulation.seed, "seed of all noise");
  command->add_option("--laser-range", options->simulation.laser.range, "m");
  command->add_option("--range-noise", options->simulation.laser.range_noise, "m, sigma");
  command->callback([options] { explore(*options); });
}

}  // namespace cca::apps
