// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>

#ifdef CCA_ROS
#include "cca_mrpt/ros/bag_log.hpp"
#endif
#include "commands.hpp"

namespace {

constexpr int kDone = 0, kRunFailed = 1, kUsage = 2;

/// What was printed may not have arrived: a full disk behind `> FILE` is told at the end only.
int withOutput(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  std::fputs("cca-mrpt: standard output: cannot be written\n", stderr);
  return status == kDone ? kRunFailed : status;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Line maps from 2-D lasers, and exploration that brings them back", "cca-mrpt"};
  program.require_subcommand(1);
#ifdef CCA_ROS
  cca::addBagLogs();
#endif
  cca::apps::addExploreCommand(program);
  cca::apps::addExtractCommand(program);
  cca::apps::addInfoCommand(program);
  cca::apps::addMapCommand(program);
  cca::apps::addRenderCommand(program);
  cca::apps::addGenerateWorldCommand(program);
  cca::apps::addCompareExtractorsCommand(program);
  cca::apps::addCompareStrategiesCommand(program);
  cca::apps::addTuneCommand(program);
  cca::apps::addEvaluateCommand(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return withOutput(program.exit(error) == 0 ? kDone : kUsage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cca-mrpt: %s\n", error.what());
    return kRunFailed;
  }
  return withOutput(kDone);
}
