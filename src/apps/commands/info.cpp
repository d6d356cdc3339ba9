// SPDX-License-Identifier: BSD-3-Clause
#include "io/logs/log_info.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "apps/options/log_hint_options.hpp"
#include "commands.hpp"
#include "io/files/text.hpp"

namespace cca::apps {
namespace {

using Json = nlohmann::ordered_json;

void row(const char* name, const std::string& value) {
  std::printf("%-12s %s\n", name, value.c_str());
}

double number(const Json& value) { return value.get<double>(); }

void printReadings(const Json& info) {
  const Json& beams = info["beams"];
  row("scans", info["scans"].dump());
  row("beams", beams[0] == beams[1] ? beams[1].dump() : beams[0].dump() + " to " + beams[1].dump());
  row("view", formatted("%g deg from %g deg, %g deg a beam", number(info["field_of_view_deg"]),
                        number(info["first_beam_deg"]), number(info["beam_step_deg"])));
  for (const Json& laser : info["lasers"]) {
    row("laser at", formatted("%g m, %g m, %g deg on the robot", number(laser["x_m"]),
                              number(laser["y_m"]), number(laser["yaw_deg"])));
  }
  row("readings", formatted("%.1f %% returns, %.1f %% no return, %.1f %% invalid",
                            100.0 * number(info["returns"]), 100.0 * number(info["no_returns"]),
                            100.0 * number(info["invalid"])));
  if (const Json& range = info["range_m"]; !range.empty()) {
    row("range", formatted("%.2f m to %.2f m, median %.2f m; noise about %.0f mm", number(range[0]),
                           number(range[2]), number(range[1]), 1e3 * number(info["noise_m"])));
  }
}

void printRun(const Json& info) {
  const Json& faults = info["time_faults"];
  row("duration", formatted("%.1f s", number(info["duration_s"])));
  row("time stamps", faults["missing"].dump() + " missing, " + faults["backwards"].dump() +
                         " backwards, " + faults["repeated"].dump() + " repeated, " +
                         faults["gaps"].dump() + " gaps");
  row("path", formatted("%.1f m, %.0f deg of turning", number(info["path_m"]),
                        number(info["turning_deg"])));
  const Json& poses = info["poses"];
  row("poses", poses["corrected"].dump() + " corrected, " + poses["odometry"].dump() +
                   " odometry, " + poses["truth"].dump() + " true");
  for (const Json& warning : info["warnings"]) row("warning", warning);
}

}  // namespace

void addInfoCommand(CLI::App& program) {
  auto* command = program.add_subcommand("info", "what is in a log");
  auto log = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  command
      ->add_option("LOG", *log,
                   "MRPT .rawlog or .simplemap, CARMEN .log, CSV of ranges, CoreSLAM .dat, csm "
                   ".json, ROS .bag")
      ->required();
  command->add_flag("--json", *json, "as JSON");
  const auto hints = addLogHintOptions(*command);
  command->callback([log, json, hints] {
    const Json info = inspectLog(*openLog(*log, *hints));
    if (*json) {
      std::printf("%s\n", info.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
      return;
    }
    row("log", *log);
    printReadings(info);
    printRun(info);
  });
}

}  // namespace cca::apps
