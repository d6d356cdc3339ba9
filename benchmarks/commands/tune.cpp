// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/options/parameter_options.hpp"
#include "commands/commands.hpp"
#include "evidence/tuning_rows.hpp"
#include "io/files/atomic_file.hpp"

namespace cca::bench {
namespace {

using namespace apps;
using namespace evidence;

struct TuningOptions {
  TuningDesign design;
  std::string shard = "1/1", out;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool merge = false;
};

struct Shard {
  std::size_t number = 1, count = 1;
};

Shard parseShard(const std::string& text) {
  Shard shard;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%zu/%zu%c", &shard.number, &shard.count, &rest) != 2 ||
      shard.number < 1 || shard.number > shard.count) {
    throw CLI::ValidationError("--shard", text + ": must be I/N with 1 <= I <= N");
  }
  return shard;
}

std::string rowsPath(const TuningOptions& options, const Shard& shard) {
  return options.out + "/rows-" + std::to_string(shard.number) + "-of-" +
         std::to_string(shard.count) + ".csv";
}

/// The jobs of this shard, shared out among threads. Neighbouring jobs share a scene, which is made
/// once and kept while somebody uses it.
class Workers {
 public:
  Workers(const TuningOptions& options, const Shard& shard, TuningRows& rows)
      : options_(options), rows_(rows) {
    for (std::size_t job = 0; job < options.design.jobs(); ++job) {
      const std::size_t scene = job / options.design.combinations();
      if (scene % shard.count == shard.number - 1 && !rows.has(job)) jobs_.push_back(job);
    }
  }

  void run() {
    std::vector<std::thread> threads;
    for (int k = 0; k < options_.threads; ++k) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void work() try {
    for (std::size_t k = next_++; k < jobs_.size(); k = next_++) {
      const TuningJob job = tuningJob(options_.design, jobs_[k]);
      const TuningRow row = runJob(job, *sceneOf(job));
      const std::lock_guard<std::mutex> lock(rows_mutex_);
      rows_.append(job, row);
      if (++done_ % 100 == 0) std::fprintf(stderr, "%zu of %zu runs\n", done_, jobs_.size());
    }
  } catch (...) {
    const std::lock_guard<std::mutex> lock(rows_mutex_);
    failure_ = std::current_exception();
    next_ = jobs_.size();
  }

  std::shared_ptr<const Scene> sceneOf(const TuningJob& job) {
    const std::lock_guard<std::mutex> lock(scene_mutex_);
    if (!scene_ || scene_number_ != job.scene) {
      scene_ = std::make_shared<const Scene>(makeScene(options_.design, job));
      scene_number_ = job.scene;
    }
    return scene_;
  }

  const TuningOptions& options_;
  TuningRows& rows_;
  std::vector<std::size_t> jobs_;
  std::atomic<std::size_t> next_{0};
  std::size_t done_ = 0;
  std::mutex rows_mutex_, scene_mutex_;
  std::shared_ptr<const Scene> scene_;
  std::size_t scene_number_ = 0;
  std::exception_ptr failure_;
};

std::vector<std::string> allRows(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("rows-", 0) == 0 && entry.path().extension() == ".csv") {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

void merge(const TuningOptions& options) {
  const std::vector<TuningRow> rows = readTuningRows(allRows(options.out), options.design);
  const std::string path = options.out + "/runs.csv";
  writeFile(path, tuningTable(options.design, rows));
  std::printf("%zu of %zu runs: %s; analysis: benchmarks/scripts/tuning_report.py %s\n",
              rows.size(), options.design.jobs(), path.c_str(), options.out.c_str());
}

/// The analysis of variance compares levels: one alone would end it after all the work.
void requireTwoLevels(const char* option, std::size_t levels) {
  if (levels < 2) throw CLI::ValidationError(option, "needs at least two levels");
}

void tune(const TuningOptions& options) {
  requireTwoLevels("--similarity-cut", options.design.similarity_cut.size());
  requireTwoLevels("--vertex-price", options.design.vertex_price.size());
  requireTwoLevels("--straightness", options.design.straightness.size());
  const Shard shard = parseShard(options.shard);
  makeFolder(options.out);
  if (!options.merge) {
    TuningRows rows(rowsPath(options, shard), options.design);
    Workers(options, shard, rows).run();
  }
  if (options.merge || shard.count == 1) merge(options);
}

}  // namespace

void addTuneCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "tune",
      "a factorial experiment over worlds, for the statistics of the three input parameters");
  auto options = std::make_shared<TuningOptions>();
  TuningDesign& design = options->design;
  command->add_option("WORLD", design.worlds, "worlds (.yaml, true segments beside them)")
      ->required();
  command->add_option("--out", options->out, "folder of the results; run again, it goes on there")
      ->required();
  const auto levels = [command](const char* name, auto& values, const std::string& key,
                                const char* meaning) {
    command->add_option(name, values, meaning)
        ->delimiter(',')
        ->check(valueOf(key))
        ->capture_default_str();
  };
  const char* two = "at least two levels, separated by commas";
  levels("--similarity-cut", design.similarity_cut, "mapping.similarity_cut", two);
  levels("--vertex-price", design.vertex_price, "mapping.vertex_price", two);
  levels("--straightness", design.straightness, "mapping.straightness", two);
  levels("--noise", design.noises, "laser.range_noise", "range noises [m], separated by commas");
  const auto count = [command](const char* name, int& value, const char* meaning) {
    command->add_option(name, value, meaning)->check(CLI::Range(1, 1000000))->capture_default_str();
  };
  count("--seeds", design.seeds, "repetitions of each world and noise");
  count("--scans", design.scans, "single scans of each scene");
  count("--poses", design.poses, "longest tour for a map, in scans");
  count("--threads", options->threads, "runs at a time");
  command->add_option("--shard", options->shard, "I/N: run only the I-th of N parts of the scenes");
  command->add_flag("--merge", options->merge,
                    "run nothing: write runs.csv of what all shards have left");
  command->callback([options] { tune(*options); });
}

}  // namespace cca::bench
