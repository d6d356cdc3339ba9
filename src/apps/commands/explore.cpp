// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "apps/options/parameter_options.hpp"
#include "apps/options/serve_options.hpp"
#include "apps/options/within.hpp"
#include "apps/options/world_name.hpp"
#include "apps/runs/decision_file.hpp"
#include "apps/runs/exploration_run.hpp"
#include "apps/runs/interruption.hpp"
#include "apps/runs/progress.hpp"
#include "apps/runs/run_window.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/simulation/laser_models.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/late_library.hpp"
#include "io/files/memory_file.hpp"
#include "io/files/text.hpp"
#include "io/maps/map_folder.hpp"
#include "io/poses/local_frame.hpp"

namespace cca::apps {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kNarrowestView = 90.0, kWidestSpacing = 5.0;  // deg

struct ExploreOptions {
  std::string world, movers, out, resume, explain;
  std::vector<double> start;  // x, y in m, heading in degrees; empty: the world's own
  std::shared_ptr<const ServeOptions> serve;
  bool gui = false, quiet = false, force = false;
};

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A simulated robot, and where its frame lies.
struct Scene {
  Simulation simulation;
  Eigen::Vector2d origin;  ///< m, map frame; see localOrigin()
};

Scene makeScene(const ExploreOptions& options, const Parameters& parameters) {
  World world = loadWorld(findWorld(options.world));
  for (const auto& key : world.unknown_keys) {
    std::fprintf(stderr, "cca-mrpt: %s: %s: is no known key and has no effect\n",
                 options.world.c_str(), key.c_str());
  }
  const auto& start = options.start;
  const Pose2 T_map_start = start.empty()
                                ? defaultStart(world, parameters.robot.radius)
                                : Pose2{start[0], start[1], wrapAngle(start[2] * M_PI / 180.0)};
  requireStandable(world, T_map_start, parameters.robot.radius);
  SimulationParameters simulated;
  simulated.robot = parameters.robot;
  simulated.laser = parameters.laser;
  simulated.odometry = parameters.odometry;
  simulated.seed = static_cast<std::uint64_t>(parameters.run.seed);
  std::vector<Mover> movers;
  if (!options.movers.empty()) movers = loadMovers(options.movers, world);
  const Eigen::Vector2d origin = localOrigin(T_map_start.position());
  world.seeFrom(origin);
  for (Mover& mover : movers) {
    mover.body.T_map_body = seenFrom(origin, mover.body.T_map_body);
    for (auto& way_point : mover.way_points) way_point -= origin;
  }
  return {Simulation(std::move(world), seenFrom(origin, T_map_start), simulated, movers), origin};
}

/// The folder that was asked for, else a fresh one: out/WORLD-001, -002, ...
std::string chooseFolder(const ExploreOptions& options, const std::string& world) {
  if (!options.out.empty()) return options.out;
  makeFolder("out");
  for (int number = 1;; ++number) {
    const std::string folder = "out/" + world + formatted("-%03d", number);
    if (fs::create_directory(folder)) return folder;
  }
}

/// What can be seen of a large world takes longer to work out than the robot drives: nobody who
/// wants his map now has to wait for it.
void awaitCoverage(Coverage& coverage, const Interruption& interruption) {
  while (!coverage.sofar()) {
    if (interruption.requested()) return coverage.giveUp();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

std::unique_ptr<RunObserver> openWindow(const World& world, double robot_radius) {
  auto* const open = reinterpret_cast<OpenRunWindow*>(lateFunction(kWindowLibrary, kOpenRunWindow));
  return std::unique_ptr<RunObserver>(open(world, robot_radius));
}

std::unique_ptr<LivePage> openPage(const ServeOptions& options, const Scene& scene) {
  LivePageSettings settings;
  settings.title = scene.simulation.world().name;
  settings.robot_radius = scene.simulation.parameters().robot.radius;
  settings.origin = scene.origin;
  settings.world = replayWorld(scene.simulation.world());
  settings.has_robot = true;
  return serve(options, settings);
}

/// With less in view the robot drives where it has not looked, and touches walls.
void requireLaser(const LaserParameters& laser) {
  if (laser.field_of_view_deg < kNarrowestView) {
    throw CLI::ValidationError("--laser.field_of_view_deg",
                               "to explore, the laser must see 90 deg at least");
  }
  const double spacing = laser.field_of_view_deg / std::max(laser.beams - 1, 1);
  if (spacing > kWidestSpacing) {
    throw CLI::ValidationError(
        "--laser.beams",
        "to explore, the laser needs a beam every 5 deg at least: " +
            std::to_string(static_cast<int>(std::ceil(laser.field_of_view_deg / kWidestSpacing)) +
                           1) +
            " beams here");
  }
}

void requireSlam(const ExploreOptions& options, const RunParameters& run) {
  if (options.resume.empty() || run.pose == "slam") return;
  throw CLI::ValidationError("--resume",
                             "needs --pose slam: who is told where it is need not find itself");
}

/// Where no place of the earlier map was found, that is told; the run's own memory does not take
/// the place of the one in its folder, which may be that map's.
void tellOfMemory(const ExploreOptions& options, const ExplorationRun& run,
                  const std::string& folder) {
  if (run.isInMemory()) return;
  std::fprintf(stderr, "cca-mrpt: no place of %s was found: this is the map of this run alone\n",
               options.resume.c_str());
  const std::string kept = keepMemory(folder);
  if (kept.empty()) return;
  std::fprintf(stderr, "cca-mrpt: the %s that was there is kept: %s\n", kMemoryFile, kept.c_str());
}

void report(const Simulation& simulation, ExplorationRun& run, const std::string& folder) {
  std::printf(
      "%s: %s. %s%.1f m driven in %.0f s, %d collisions, %.1f s of work\n"
      "picture  %s/map.png\nmap      %s/lines.csv\n",
      simulation.world().name.c_str(), run.end().reason.c_str(),
      seenText(run.record().coverage().sofar()).c_str(), simulation.distance(), simulation.time(),
      simulation.collisions(), run.end().wall_s, folder.c_str(), folder.c_str());
}

void explore(const ExploreOptions& options, const Parameters& parameters) {
  const auto start = Clock::now();
  requireLaser(parameters.laser);
  requireSlam(options, parameters.run);
  Scene scene = makeScene(options, parameters);
  std::optional<SlamMemory> memory;
  if (!options.resume.empty()) memory = seenFrom(scene.origin, loadMemory(options.resume));
  Simulation& simulation = scene.simulation;
  std::unique_ptr<RunObserver> window;
  if (options.gui) window = openWindow(simulation.world(), parameters.robot.radius);
  const std::unique_ptr<LivePage> page = openPage(*options.serve, scene);
  std::optional<DecisionFile> decisions;
  if (!options.explain.empty()) {
    requireNew(options.explain, options.force);
    requireApart(options.explain, {options.world, options.movers});
    decisions.emplace(options.explain, scene.origin);
  }
  const std::string folder = chooseFolder(options, simulation.world().name);
  const FolderLock lock = prepareMapFolder(folder, options.force, ExplorationRecord::files());
  ExplorationRun run(simulation, scene.origin, parameters, folder);
  if (memory) run.remember(*memory);
  if (decisions) run.explainTo(*decisions);
  std::unique_ptr<Progress> progress;
  if (!options.quiet) progress = std::make_unique<Progress>("exploring");
  const Interruption interruption;
  if (window) run.addObserver(*window);
  if (page) run.obey(*page);
  run.drive(interruption, progress.get());
  progress.reset();
  if (interruption.requested()) tellOfSaving();
  run.finish();
  tellOfMemory(options, run, folder);
  awaitCoverage(run.record().coverage(), interruption);
  run.end().wall_s = secondsSince(start);
  run.record().write(simulation, run.session().mapping(), run.slam(), run.end());
  if (page) page->finish(run.session().mapping().lineMap().lines(), run.end().reason);
  if (decisions) decisions->commit();
  if (!options.quiet) report(simulation, run, folder);
  if (!run.end().finished) {
    throw std::runtime_error(run.end().reason + "; what was mapped so far is in " + folder);
  }
  const std::string shortcoming = run.shortcomings();
  if (!shortcoming.empty()) throw Shortcoming(shortcoming + "; the map is in " + folder);
}

}  // namespace

void addExploreCommand(CLI::App& program) {
  auto* command = program.add_subcommand("explore", "simulated exploration of a world");
  auto options = std::make_shared<ExploreOptions>();
  command
      ->add_option("WORLD", options->world,
                   "world: a map_server YAML file, or the name of one of ours, e.g. office")
      ->required();
  command->add_option("--start", options->start, "X,Y,DEG: start pose, m and degrees")
      ->delimiter(',')
      ->expected(3)
      ->check(within(-2e7, 2e7));
  command->add_option("--movers", options->movers, "what moves about, a YAML file");
  command->add_option("--resume", options->resume,
                      "DIR of an earlier map: go on with it, from anywhere in it");
  command->add_flag("--gui", options->gui, "show the run in MRPT's 3-D window");
  options->serve = addServeOptions(*command);
  command->add_option("--out", options->out, "folder for the results; else out/WORLD-001, ...");
  command->add_option("--explain", options->explain,
                      "file for each decision as a JSON line: candidates, promise, way, score");
  command->add_flag("--force", options->force, "overwrite results that are in the folder");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  auto parameters = std::make_shared<ParameterOptions>(
      *command, std::vector<std::string>{"run", "mapping", "exploration", "robot", "laser",
                                         "odometry", "icp"});
  parameters->addPreset("--laser",
                        "a laser by name: " + laserModelNames() + "; options --laser.* change it",
                        [](const std::string& name, Parameters& p) {
                          p.laser = laserModel(name).laser;
                          p.run.control_period = 1.0 / laserModel(name).rate;
                        });
  parameters->addAlias("--strategy", "exploration.strategy");
  parameters->addAlias("--seed", "run.seed");
  parameters->addAlias("--pose", "run.pose");
  parameters->addAlias("--laser-range", "laser.range");
  parameters->addAlias("--range-noise", "laser.range_noise");
  command->callback([options, parameters] { explore(*options, parameters->resolve()); });
}

}  // namespace cca::apps
