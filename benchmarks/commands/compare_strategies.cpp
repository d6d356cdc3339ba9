// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "apps/options/moved.hpp"
#include "apps/options/parameter_options.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "cca_mrpt/simulation/laser_models.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "commands/commands.hpp"
#include "io/files/atomic_file.hpp"

namespace cca::bench {
namespace {

using namespace apps;

constexpr double kLevels[] = {0.90, 0.95, 0.99};

struct CompareOptions {
  std::vector<std::string> worlds, strategies;
  int starts = 3;
  std::string out = "out/strategies";
};

struct Run {
  std::string world, strategy;
  std::size_t world_number = 0;
  int number = 0;  ///< of the start; the seed too
  Pose2 T_map_start;
};

struct CurvePoint {
  double distance, coverage;
};

struct Result {
  std::vector<CurvePoint> curve;
  double distance = 0.0, duration = 0.0, coverage = 0.0;
  int collisions = 0;
  bool finished = false;
};

/// Start 0 is the world's own; the others are drawn among the places where the robot can stand and
/// that can be seen from there by driving.
std::vector<Pose2> drawStarts(const World& world, const Parameters& parameters, int count) {
  const double radius = parameters.robot.radius;
  std::vector<Pose2> starts{defaultStart(world, radius)};
  requireStandable(world, starts.front(), radius);
  const auto visible = visibleCells(world, starts.front().position(), radius, 8.0);
  const auto width = static_cast<std::size_t>(world.grid().getSizeX());
  std::mt19937 random(1);
  for (int tries = 0; static_cast<int>(starts.size()) < count && tries < 100000; ++tries) {
    const std::size_t cell = random() % visible.size();
    if (!visible[cell]) continue;
    const Eigen::Vector2d p_grid(world.grid().idx2x(static_cast<int>(cell % width)),
                                 world.grid().idx2y(static_cast<int>(cell / width)));
    const Eigen::Vector2d p_map = world.origin() + p_grid;
    if (world.clearance(p_map, radius) >= radius) starts.push_back({p_map.x(), p_map.y(), 0.0});
  }
  if (static_cast<int>(starts.size()) < count) {
    throw std::runtime_error(world.name + ": no place is found for so many starts");
  }
  return starts;
}

Result perform(const Run& run, const World& world, const Parameters& parameters) {
  SimulationParameters simulated;
  simulated.robot = parameters.robot;
  simulated.laser = parameters.laser;
  simulated.seed = static_cast<std::uint64_t>(run.number) + 1;
  Simulation simulation(world, run.T_map_start, simulated);
  ExplorerParameters exploration = parameters.exploration;
  for (const auto& [name, strategy] : kStrategyNames) {
    if (run.strategy == name) exploration.strategy = strategy;
  }
  Explorer explorer(parameters.robot, exploration);
  Coverage coverage(world, run.T_map_start.position(), parameters.robot.radius,
                    parameters.laser.range);
  Result result;
  std::vector<double> distances;
  std::optional<Pose2> last_look;
  while (simulation.time() < parameters.run.longest_time) {
    const Observation observation = simulation.observe();
    const Action action = explorer.step(observation);
    result.finished = action.status == ExplorationStatus::kFinished;
    if (keepIfMoved(last_look, simulation.T_map_robot()) || result.finished) {
      coverage.look(simulation.T_map_robot());
      distances.push_back(simulation.distance());
    }
    if (result.finished) break;
    simulation.drive(action.velocity, parameters.run.control_period);
  }
  const auto seen = coverage.curve();
  for (std::size_t i = 0; i < seen.size(); ++i) result.curve.push_back({distances[i], seen[i]});
  result.distance = simulation.distance();
  result.duration = simulation.time();
  result.coverage = seen.empty() ? 0.0 : seen.back();
  result.collisions = simulation.collisions();
  return result;
}

std::optional<double> distanceTo(const Result& result, double level) {
  for (const CurvePoint& p : result.curve) {
    if (p.coverage >= level) return p.distance;
  }
  return {};
}

std::string inMetres(const std::optional<double>& distance) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", distance.value_or(0.0));
  return distance ? text : "-";
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string table(const std::vector<Run>& runs, const std::vector<Result>& results) {
  std::string text =
      "world,strategy,start,to_90_m,to_95_m,to_99_m,distance_m,duration_s,coverage,"
      "collisions,finished\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    text += runs[i].world + "," + runs[i].strategy + "," + std::to_string(runs[i].number);
    for (const double level : kLevels) text += "," + inMetres(distanceTo(results[i], level));
    text += format(",%.2f,%.1f,%.5f,%d,%d\n", results[i].distance, results[i].duration,
                   results[i].coverage, results[i].collisions, results[i].finished ? 1 : 0);
  }
  return text;
}

std::string curves(const std::vector<Run>& runs, const std::vector<Result>& results) {
  std::string text = "world,strategy,start,distance_m,coverage\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const CurvePoint& p : results[i].curve) {
      text += runs[i].world + "," + runs[i].strategy +
              format(",%d,%.2f,%.5f\n", runs[i].number, p.distance, p.coverage);
    }
  }
  return text;
}

/// Means over the starts; '-' where a start did not get to the level.
std::string markdown(const CompareOptions& options, const std::vector<Run>& runs,
                     const std::vector<Result>& results) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> cells;
  std::vector<std::string> worlds;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (worlds.empty() || worlds.back() != runs[i].world) worlds.push_back(runs[i].world);
    cells[{runs[i].world, runs[i].strategy}].push_back(i);
  }
  std::string text = "| world |", rule = "\n|---|";
  for (const auto& strategy : options.strategies) {
    text += " " + strategy + " |";
    rule += "---|";
  }
  text += rule;
  for (const auto& world : worlds) {
    text += "\n| " + world + " |";
    for (const auto& strategy : options.strategies) {
      const auto& cell = cells[{world, strategy}];
      for (const double level : kLevels) {
        std::optional<double> mean = 0.0;
        for (const std::size_t i : cell) {
          const auto distance = distanceTo(results[i], level);
          mean = mean && distance
                     ? std::optional<double>(*mean + *distance / static_cast<double>(cell.size()))
                     : std::nullopt;
        }
        text += (level == kLevels[0] ? " " : " / ") + inMetres(mean);
      }
      text += " |";
    }
  }
  return text + "\n";
}

/// All runs, as many at a time as the machine has cores. @throws what the first to fail threw.
std::vector<Result> performAll(const std::vector<Run>& runs, const std::vector<World>& worlds,
                               const Parameters& parameters) {
  std::vector<Result> results(runs.size());
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next++) < runs.size();) {
        results[i] = perform(runs[i], worlds[runs[i].world_number], parameters);
        std::fprintf(stderr, "%s, %s, start %d: %.1f m, %.2f %% seen\n", runs[i].world.c_str(),
                     runs[i].strategy.c_str(), runs[i].number, results[i].distance,
                     100.0 * results[i].coverage);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!failure) failure = std::current_exception();
      next = runs.size();
    }
  };
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < std::max(1u, std::thread::hardware_concurrency()); ++t) {
    threads.emplace_back(work);
  }
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
  return results;
}

void compare(const CompareOptions& options, const Parameters& parameters) {
  std::vector<World> worlds;
  std::vector<Run> runs;
  for (const auto& path : options.worlds) {
    World world = loadWorld(path);
    for (const World& other : worlds) {
      if (other.name == world.name)
        throw std::runtime_error(path + ": a second world of this name");
    }
    const auto starts = drawStarts(world, parameters, options.starts);
    for (const auto& strategy : options.strategies) {
      for (std::size_t k = 0; k < starts.size(); ++k) {
        runs.push_back({world.name, strategy, worlds.size(), static_cast<int>(k), starts[k]});
      }
    }
    worlds.push_back(std::move(world));
  }
  makeFolder(options.out);
  const std::vector<Result> results = performAll(runs, worlds, parameters);
  writeFile(options.out + "/runs.csv", table(runs, results));
  writeFile(options.out + "/curves.csv", curves(runs, results));
  writeFile(options.out + "/strategies.md", markdown(options, runs, results));
  std::printf("%s/strategies.md, runs.csv, curves.csv\n", options.out.c_str());
}

}  // namespace

void addCompareStrategiesCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "compare-strategies",
      "every strategy on the same worlds, starts and seeds: how far it drives");
  auto options = std::make_shared<CompareOptions>();
  for (const auto& named : kStrategyNames) options->strategies.push_back(named.first);
  command->add_option("WORLD", options->worlds, "worlds, map_server YAML files")->required();
  command->add_option("--strategies", options->strategies, "names, comma-separated")
      ->delimiter(',')
      ->check(CLI::IsMember(options->strategies))
      ->capture_default_str();
  command->add_option("--starts", options->starts, "starts in each world")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--out", options->out, "folder for the results")->capture_default_str();
  // Strategies are compared by what they decide: with true poses and scans of one instant.
  Parameters defaults;
  defaults.laser = laserModel("ideal").laser;
  auto parameters = std::make_shared<ParameterOptions>(
      *command,
      std::vector<std::string>{"run.control_period", "run.longest_time", "mapping",
                               "exploration.path", "exploration.worth", "exploration.smallest_gain",
                               "exploration.return_to_start", "robot", "laser"},
      defaults);
  command->callback([options, parameters] { compare(*options, parameters->resolve()); });
}

}  // namespace cca::bench
