// SPDX-License-Identifier: BSD-3-Clause
#ifdef CCA_ROS
#include "ros/bags/bag_log.hpp"
#endif
#include "apps/commands/commands.hpp"

int main(int argc, char** argv) {
  CLI::App program{"Line maps from 2-D lasers, and exploration that brings them back", "cca-mrpt"};
#ifdef CCA_ROS
  cca::addBagLogs();
#endif
  cca::apps::addExploreCommand(program);
  cca::apps::addExtractCommand(program);
  cca::apps::addInfoCommand(program);
  cca::apps::addLocalizeCommand(program);
  cca::apps::addMapCommand(program);
  cca::apps::addMergeCommand(program);
  cca::apps::addPlanCommand(program);
  cca::apps::addRenderCommand(program);
  cca::apps::addGenerateWorldCommand(program);
  cca::apps::addEvaluateCommand(program);
  return cca::apps::runProgram(program, argc, argv);
}
