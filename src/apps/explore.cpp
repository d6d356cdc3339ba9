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

#include "background_work.hpp"
#include "belief.hpp"
#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/late_library.hpp"
#include "cca_mrpt/io/local_frame.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/memory_file.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "commands.hpp"
#include "contradiction.hpp"
#include "exploration_record.hpp"
#include "exploration_window.hpp"
#include "interruption.hpp"
#include "moved.hpp"
#include "parameter_options.hpp"
#include "progress.hpp"
#include "replay_moment.hpp"
#include "tour_left.hpp"
#include "within.hpp"
#include "world_name.hpp"

namespace cca::apps {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A robot that has not found its place on so much way [m] is not exploring any more.
constexpr double kLongestLost = 30.0;
constexpr double kSmallestView = 90.0, kWidestSpacing = 5.0;  // deg

struct ExploreOptions {
  std::string world, movers, out, resume;
  std::vector<double> start;  // x, y in m, heading in degrees; empty: the world's own
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
  std::string folder = options.out;
  if (folder.empty()) {
    makeFolder("out");
    for (int number = 1; folder.empty(); ++number) {
      char name[16];
      std::snprintf(name, sizeof name, "-%03d", number);
      if (fs::create_directory("out/" + world + name)) folder = "out/" + world + name;
    }
  }
  return folder;
}

/// "91.3 % seen, ", or nothing where it is not known.
std::string share(const std::optional<double>& seen) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %% seen, ", 100.0 * seen.value_or(0.0));
  return seen ? text : "";
}

/// How far the robot still has to go, as far as it knows: to each frontier.
double metresLeft(const Simulation& simulation, const Explorer& explorer) {
  std::vector<Eigen::Vector2d> frontier;
  for (const Cell& cell : explorer.planner().place().frontierCells().cells()) {
    frontier.push_back(explorer.grid().centreOf(cell));
  }
  return tourLeft(simulation.T_map_robot().position(), frontier);
}

void showProgress(Progress& progress, const Simulation& simulation, const Explorer& explorer,
                  ExplorationRecord& record, const Action& action, Clock::time_point begin) {
  char detail[160], goal[40] = "none";
  if (action.goal)
    std::snprintf(goal, sizeof goal, "%.1f, %.1f", record.origin().x() + action.goal->x(),
                  record.origin().y() + action.goal->y());
  const double driven = simulation.distance(), left = metresLeft(simulation, explorer);
  std::snprintf(detail, sizeof detail,
                "%s%.0f m driven, %.0f m to go, %.0f s simulated, goal %s, %.0f scans/s",
                share(record.coverage().sofar()).c_str(), driven, left, simulation.time(), goal,
                static_cast<double>(record.scans()) / std::max(secondsSince(begin), 1e-3));
  progress.show(driven + left > 0.0 ? driven / (driven + left) : 0.0, detail);
}

void correctMap(const PastScans& past, std::size_t remembered, Explorer& explorer,
                ExplorationRecord& record) {
  explorer.correctMap(past);
  record.correct(past, remembered);
}

// The line map and the files are kept beside the drive, on the second core: neither feeds back.
ExplorationRecord::End drive(Simulation& simulation, Explorer& explorer, ExplorationRecord& record,
                             Belief& belief, const RunParameters& run,
                             const Interruption& interruption, Progress* progress,
                             ExplorationWindow* window) {
  const auto begin = Clock::now();
  double placed_at = 0.0;  // m of way
  std::optional<Pose2> last_moment;
  BackgroundWork beside;
  while (!interruption.requested() && simulation.time() < run.longest_time) {
    Observation observation = simulation.observe();
    const auto start = Clock::now();
    if (belief.replacePose(observation, simulation.T_odom_robot())) {
      explorer.correctNavigation(belief.past());
      beside.add(
          [&, past = belief.past()] { correctMap(past, belief.remembered(), explorer, record); });
    }
    const Action action = explorer.navigate(observation);
    ExplorationRecord::Cycle cycle{
        simulation.time(),         simulation.distance(), simulation.T_map_robot(),
        simulation.T_odom_robot(), observation,           action.goal,
        1e6 * secondsSince(start)};
    std::optional<ReplayMoment> moment;
    if (keepIfMoved(last_moment, observation.T_map_robot) ||
        action.status == ExplorationStatus::kFinished) {
      moment = momentOf(simulation, explorer, observation, action);
    }
    beside.add([&, cycle = std::move(cycle), moment = std::move(moment)]() mutable {
      const auto map_start = Clock::now();
      if (cycle.believed.is_placed) explorer.map(cycle.believed.scan);
      cycle.work_us += 1e6 * secondsSince(map_start);
      record.add(cycle);
      if (moment) record.replay().add(*moment, cycle.believed.scan, explorer.lineMap());
    });
    if (observation.is_placed) placed_at = simulation.distance();
    if (simulation.distance() - placed_at > kLongestLost) {
      beside.wait();
      return {false,
              "the robot has not known its place for " +
                  std::to_string(static_cast<int>(kLongestLost)) + " m",
              0.0};
    }
    if (action.status == ExplorationStatus::kFinished) {
      beside.wait();
      const Plan& plan = explorer.planner().plan();
      return {true, action.reason, 0.0, plan.unreached, explorer.leavesMuch(), plan.gave_up};
    }
    simulation.drive(action.velocity, run.control_period);
    if (window && window->isDue()) {
      beside.wait();
      window->show(record.products(simulation, explorer), simulation, observation, action);
    }
    if (progress && progress->isDue()) {
      beside.wait();
      showProgress(*progress, simulation, explorer, record, action, begin);
    }
  }
  beside.wait();
  return {false, interruption.requested() ? "interrupted" : "the longest simulated time is over",
          0.0};
}

/// What can be seen of a large world takes longer to work out than the robot drives: nobody who
/// wants his map now has to wait for it.
void awaitCoverage(Coverage& coverage, const Interruption& interruption) {
  while (!coverage.sofar()) {
    if (interruption.requested()) return coverage.giveUp();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// What a run that ended by itself has not done well; empty where there is nothing.
std::string shortcomings(const Simulation& simulation, const Explorer& explorer,
                         const ExplorationRecord::End& end) {
  std::string text;
  char part[80];
  const auto tell = [&text](const std::string& what) {
    text += (text.empty() || what.empty() ? "" : ", ") + what;
  };
  if (simulation.collisions() > 0) {
    std::snprintf(part, sizeof part, "%d contacts with what stands", simulation.collisions());
    tell(part);
  }
  if (end.gave_up) tell(end.reason);
  if (end.leaves_much) {
    std::snprintf(part, sizeof part, "%.1f m^2 in view that no way was found to", end.unreached);
    tell(part);
  }
  tell(contradiction(explorer.agreement()));
  return text;
}

std::unique_ptr<ExplorationWindow> openWindow(const World& world) {
  auto* const open = reinterpret_cast<OpenExplorationWindow*>(
      lateFunction(kWindowLibrary, kOpenExplorationWindow));
  return std::unique_ptr<ExplorationWindow>(open(world));
}

/// With less in view the robot drives where it has not looked, and touches walls.
void requireLaser(const LaserParameters& laser) {
  if (laser.field_of_view_deg < kSmallestView) {
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
void tellOfMemory(const ExploreOptions& options, const Belief& belief, const std::string& folder) {
  if (belief.remembered() == 0 || belief.slam()->isInMemory()) return;
  std::fprintf(stderr, "cca-mrpt: no place of %s was found: this is the map of this run alone\n",
               options.resume.c_str());
  const std::string kept = keepMemory(folder);
  if (kept.empty()) return;
  std::fprintf(stderr, "cca-mrpt: the %s that was there is kept: %s\n", kMemoryFile, kept.c_str());
}

void explore(const ExploreOptions& options, const Parameters& parameters) {
  const auto start = Clock::now();
  requireLaser(parameters.laser);
  requireSlam(options, parameters.run);
  Scene scene = makeScene(options, parameters);
  std::optional<SlamMemory> memory;
  if (!options.resume.empty()) memory = seenFrom(scene.origin, loadMemory(options.resume));
  Simulation& simulation = scene.simulation;
  std::unique_ptr<ExplorationWindow> window;
  if (options.gui) window = openWindow(simulation.world());
  const std::string folder = chooseFolder(options, simulation.world().name);
  const FolderLock lock = prepareMapFolder(folder, options.force, ExplorationRecord::files());
  Explorer explorer(parameters.mapping, parameters.robot, parameters.exploration);
  ExplorationRecord record(simulation, scene.origin, parameters, folder);
  Belief belief(parameters, simulation.T_map_robot());
  if (memory) belief.remember(*memory);
  std::unique_ptr<Progress> progress;
  if (!options.quiet) progress = std::make_unique<Progress>("exploring");
  const Interruption interruption;
  auto end = drive(simulation, explorer, record, belief, parameters.run, interruption,
                   progress.get(), window.get());
  progress.reset();
  if (interruption.requested()) tellOfSaving();
  if (belief.finish()) correctMap(belief.past(), belief.remembered(), explorer, record);
  tellOfMemory(options, belief, folder);
  awaitCoverage(record.coverage(), interruption);
  end.wall_s = secondsSince(start);
  record.write(simulation, explorer, belief, end);
  if (!options.quiet) {
    std::printf(
        "%s: %s. %s%.1f m driven in %.0f s, %d collisions, %.1f s of work\n"
        "picture  %s/map.png\nmap      %s/lines.csv\n",
        simulation.world().name.c_str(), end.reason.c_str(),
        share(record.coverage().sofar()).c_str(), simulation.distance(), simulation.time(),
        simulation.collisions(), end.wall_s, folder.c_str(), folder.c_str());
  }
  if (!end.finished) {
    throw std::runtime_error(end.reason + "; what was mapped so far is in " + folder);
  }
  const std::string shortcoming = shortcomings(simulation, explorer, end);
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
  command->add_option("--out", options->out, "folder for the results; else out/WORLD-001, ...");
  command->add_flag("--force", options->force, "overwrite results that are in the folder");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  auto parameters = std::make_shared<ParameterOptions>(
      *command, std::vector<std::string>{"run", "mapping", "exploration", "robot", "laser",
                                         "odometry", "icp"});
  parameters->addAlias("--strategy", "exploration.strategy");
  parameters->addAlias("--seed", "run.seed");
  parameters->addAlias("--pose", "run.pose");
  parameters->addAlias("--laser-range", "laser.range");
  parameters->addAlias("--range-noise", "laser.range_noise");
  command->callback([options, parameters] { explore(*options, parameters->resolve()); });
}

}  // namespace cca::apps
