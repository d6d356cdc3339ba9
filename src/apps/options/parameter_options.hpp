// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/io/parameters.hpp"

namespace cca::apps {

/// Accepts what the parameter SECTION.KEY may be, for options that give it several values.
CLI::Validator valueOf(const std::string& key);

/// The options that every sub-command has in common: --config FILE.ini, --dump-config, and one
/// --SECTION.KEY for each parameter of the named sections. Must outlive the parsing.
class ParameterOptions {
 public:
  /// @param sections  those that the command uses, or SECTION.KEY for one parameter of a section;
  ///                  others are neither shown nor accepted on the command line, but may stand in
  ///                  the .ini.
  /// @param defaults  what nobody sets.
  ParameterOptions(CLI::App& command, const std::vector<std::string>& sections,
                   const Parameters& defaults = {});

  /// A parameter under another name, e.g. addAlias("--laser-range", "laser.range"); not both.
  void addAlias(const std::string& option, const std::string& key);

  /// An option that names a set of values to begin with, e.g. --laser.
  /// @param apply  sets them; throws std::runtime_error where there is no such name.
  void addPreset(const std::string& option, const std::string& help,
                 std::function<void(const std::string&, Parameters&)> apply);

  /// Defaults, presets, then the .ini, then the command line.
  /// @throws CLI::ValidationError (exit status 2) naming file or option, key, value and range.
  Parameters resolve() const;

 private:
  CLI::Option* addOption(const std::string& option, const ParameterField& field);

  struct Preset {
    CLI::Option* option;
    std::function<void(const std::string&, Parameters&)> apply;
  };

  CLI::App& command_;
  Parameters defaults_;
  std::vector<Preset> presets_;
  CLI::Option* config_ = nullptr;
  std::vector<std::pair<std::string, CLI::Option*>> options_;  // key, option
};

}  // namespace cca::apps
