// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_options.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace cca::apps {
namespace {

/// The parameter SECTION.KEY of p, which must outlive it.
ParameterField fieldOf(Parameters& p, const std::string& key) {
  for (const auto& field : listParameters(p)) {
    if (field.key() == key) return field;
  }
  throw std::logic_error("no parameter " + key);
}

}  // namespace

CLI::Validator valueOf(const std::string& key) {
  const auto complaint = [key](const std::string& text) -> std::string {
    Parameters parameters;
    try {
      fieldOf(parameters, key).set(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  return CLI::Validator(complaint, "");
}

ParameterOptions::ParameterOptions(CLI::App& command, const std::vector<std::string>& sections,
                                   const Parameters& defaults)
    : command_(command), defaults_(defaults) {
  config_ = command.add_option("--config", "parameters from an MRPT .ini file")
                ->type_name("FILE.ini")
                ->expected(1);
  command.add_flag_callback(
      "--dump-config",
      [this] {
        std::fputs(dumpParameters(resolve()).c_str(), stdout);
        throw CLI::Success();
      },
      "print every parameter with its value, range, unit and meaning, and stop");
  for (const auto& field : listParameters(defaults_)) {
    const auto names = [&](const std::string& s) { return s == field.section || s == field.key(); };
    if (std::none_of(sections.begin(), sections.end(), names)) continue;
    addOption("--" + field.key(), field)->group("Parameters");
  }
}

CLI::Option* ParameterOptions::addOption(const std::string& option, const ParameterField& field) {
  const std::string help = field.meaning + "; " + field.allowed;
  options_.emplace_back(field.key(), command_.add_option(option, help));
  return options_.back().second->type_name("[" + field.get() + "]")->expected(1);
}

void ParameterOptions::addAlias(const std::string& option, const std::string& key) {
  addOption(option, fieldOf(defaults_, key))->excludes(command_.get_option_no_throw("--" + key));
}

void ParameterOptions::addPreset(const std::string& option, const std::string& help,
                                 std::function<void(const std::string&, Parameters&)> apply) {
  presets_.push_back({command_.add_option(option, help)->expected(1), std::move(apply)});
}

Parameters ParameterOptions::resolve() const {
  Parameters p = defaults_;
  for (const auto& [option, apply] : presets_) {
    if (!option->count()) continue;
    try {
      apply(option->results().front(), p);
    } catch (const std::runtime_error& error) {
      throw CLI::ValidationError(option->get_name(), error.what());
    }
  }
  try {
    if (config_->count()) loadParameters(config_->results().front(), p);
  } catch (const std::runtime_error& error) {
    throw CLI::ValidationError("--config", error.what());
  }
  for (const auto& [key, option] : options_) {
    if (!option->count()) continue;
    try {
      fieldOf(p, key).set(option->results().front());
    } catch (const std::runtime_error& error) {
      throw CLI::ValidationError(option->get_name(), error.what());
    }
  }
  return p;
}

}  // namespace cca::apps
