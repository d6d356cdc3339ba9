// SPDX-License-Identifier: BSD-3-Clause
#include "apps/program.hpp"
#include "commands/commands.hpp"

int main(int argc, char** argv) {
  CLI::App program{"What CCA's claims rest on: comparisons, tuning, ablation", "cca-mrpt-bench"};
  cca::bench::addAblateCommand(program);
  cca::bench::addCompareExtractorsCommand(program);
  cca::bench::addCompareLocalisationCommand(program);
  cca::bench::addCompareSlamCommand(program);
  cca::bench::addCompareStrategiesCommand(program);
  cca::bench::addTuneCommand(program);
  return cca::apps::runProgram(program, argc, argv);
}
