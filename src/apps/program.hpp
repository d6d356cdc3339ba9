// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace cca::apps {

/// The run is done and its results are written, and something about it is not as it should be.
class Shortcoming : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs the sub-command that the arguments name; the program has its sub-commands already.
///
/// @return  exit status: 0 done; 1 the command threw std::exception, or its output cannot be
///          written; 2 no such command or option, or a value that is not allowed; 3 the command
///          threw Shortcoming. Messages go to stderr and begin with the program's name.
int runProgram(CLI::App& program, int argc, char** argv);

}  // namespace cca::apps
