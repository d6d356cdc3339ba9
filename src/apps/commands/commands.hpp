// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

/// Each adds one sub-command to the program, in a file of its own; the work is done in the
/// sub-command's callback, which throws std::runtime_error where the run fails, Shortcoming where
/// it is done but falls short.
namespace cca::apps {

/// The run is done and its results are written, and something about it is not as it should be.
class Shortcoming : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void addAblateCommand(CLI::App& program);
void addExploreCommand(CLI::App& program);
void addExtractCommand(CLI::App& program);
void addInfoCommand(CLI::App& program);
void addLocalizeCommand(CLI::App& program);
void addMapCommand(CLI::App& program);
void addMergeCommand(CLI::App& program);
void addPlanCommand(CLI::App& program);
void addRenderCommand(CLI::App& program);
void addGenerateWorldCommand(CLI::App& program);
void addCompareExtractorsCommand(CLI::App& program);
void addCompareLocalisationCommand(CLI::App& program);
void addCompareSlamCommand(CLI::App& program);
void addCompareStrategiesCommand(CLI::App& program);
void addTuneCommand(CLI::App& program);
void addEvaluateCommand(CLI::App& program);

}  // namespace cca::apps
