// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#ifdef CCA_ROS
#include "ros/bags/bag_log.hpp"
#endif
#include "apps/commands/commands.hpp"

namespace {

constexpr int kDone = 0, kRunFailed = 1, kUsage = 2, kFellShort = 3;
const std::string kStatuses =
    "Exit status: 0 done; 1 failed, or interrupted (what was mapped so far is saved);\n"
    "2 no such command or option, or a value that is not allowed; 3 done, but the result\n"
    "falls short, as the last message says (contacts, scans that contradict the map, ...).";

/// MRPT's own errors are pages with a call stack; the cause stands behind "Message:".
std::string withoutCallStack(const std::string& error) {
  const std::string key = "Message:";
  const std::size_t found = error.find(key);
  if (error.rfind("==== MRPT", 0) != 0 || found == std::string::npos) return error;
  const std::size_t begin = error.find_first_not_of(' ', found + key.size());
  return error.substr(begin, error.find('\n', begin) - begin);
}

bool isCommand(const CLI::App& program, const std::string& name) {
  return !program.get_subcommands([&](const CLI::App* c) { return c->get_name() == name; }).empty();
}

/// What was printed may not have arrived: a full disk behind `> FILE` is told at the end only.
int withOutput(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  std::fputs("cca-mrpt: standard output: cannot be written\n", stderr);
  return status == kDone ? kRunFailed : status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is an error to tell of, as a full disk is
  CLI::App program{"Line maps from 2-D lasers, and exploration that brings them back", "cca-mrpt"};
  program.require_subcommand(1);
  program.set_version_flag("--version", "cca-mrpt " CCA_VERSION);
#ifdef CCA_ROS
  cca::addBagLogs();
#endif
  std::string missing;
  cca::apps::addExploreCommand(program);
  cca::apps::addExtractCommand(program);
  cca::apps::addInfoCommand(program);
  cca::apps::addLocalizeCommand(program);
  cca::apps::addMapCommand(program);
  cca::apps::addMergeCommand(program);
  cca::apps::addPlanCommand(program);
  cca::apps::addRenderCommand(program);
  cca::apps::addGenerateWorldCommand(program);
#ifdef CCA_EVIDENCE
  cca::apps::addCompareExtractorsCommand(program);
  cca::apps::addCompareLocalisationCommand(program);
  cca::apps::addCompareSlamCommand(program);
  cca::apps::addCompareStrategiesCommand(program);
  cca::apps::addTuneCommand(program);
  cca::apps::addAblateCommand(program);
  cca::apps::addEvaluateCommand(program);
#else
  missing =
      "\n\nThis build has no ablate, evaluate, compare-extractors,\n"
      "compare-localisation, compare-slam, compare-strategies and tune\n"
      "(cmake -D CCA_WITH_EVIDENCE=ON, as launch_scripts/test.sh builds it).";
#endif
  program.footer(kStatuses + missing);
  if (argc > 1 && argv[1][0] != '-' && !isCommand(program, argv[1])) {
    std::fprintf(stderr, "%s is no command of cca-mrpt; see cca-mrpt --help\n", argv[1]);
    return kUsage;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return withOutput(program.exit(error) == 0 ? kDone : kUsage);
  } catch (const cca::apps::Shortcoming& shortcoming) {
    std::fprintf(stderr, "cca-mrpt: %s\n", shortcoming.what());
    return withOutput(kFellShort);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cca-mrpt: %s\n", withoutCallStack(error.what()).c_str());
    return kRunFailed;
  }
  return withOutput(kDone);
}
