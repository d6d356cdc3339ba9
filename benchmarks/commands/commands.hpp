// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

/// The sub-commands of cca-mrpt-bench, each in a file of its own; the rules are those of
/// apps/commands/commands.hpp.
namespace cca::bench {

void addAblateCommand(CLI::App& program);
void addCompareExtractorsCommand(CLI::App& program);
void addCompareLocalisationCommand(CLI::App& program);
void addCompareSlamCommand(CLI::App& program);
void addCompareStrategiesCommand(CLI::App& program);
void addTuneCommand(CLI::App& program);

}  // namespace cca::bench
