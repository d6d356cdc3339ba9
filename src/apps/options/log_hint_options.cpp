// SPDX-License-Identifier: BSD-3-Clause
#include "log_hint_options.hpp"

#include <cmath>
#include <cstdio>

namespace cca::apps {
namespace {

/// "X,Y,YAW_DEG" or "X,Y,YAW_DEG,upside-down".
SensorMount parseMount(const std::string& text) {
  double x = 0.0, y = 0.0, yaw_deg = 0.0;
  int end = 0;
  const int numbers = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &x, &y, &yaw_deg, &end);
  const std::string rest = numbers == 3 ? text.substr(static_cast<std::size_t>(end)) : text;
  const bool is_sound = numbers == 3 && std::isfinite(x + y + yaw_deg);
  if (!is_sound || !(rest.empty() || rest == ",upside-down")) {
    throw CLI::ValidationError("--mount", "'" + text +
                                              "': X,Y,YAW_DEG or X,Y,YAW_DEG,upside-down, in "
                                              "metres and degrees, e.g. 0.12,0,180");
  }
  return {{x, y, wrapAngle(yaw_deg * M_PI / 180.0)}, !rest.empty()};
}

}  // namespace

std::shared_ptr<const LogHints> addLogHintOptions(CLI::App& command) {
  auto hints = std::make_shared<LogHints>();
  const std::string group = "Of ROS bags";
  command
      .add_option("--topic", hints->topic,
                  "laser to read; by default the topic with most laser scans")
      ->group(group);
  command
      .add_option("--base-frame", hints->base_frame,
                  "frame of the robot; by default the base_link that the laser hangs on, or what "
                  "stands for it")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--mount", [hints](const std::string& text) { hints->mount = parseMount(text); },
          "X,Y,YAW_DEG[,upside-down] of the laser on the robot, where tf does not tell it")
      ->group(group);
  return hints;
}

}  // namespace cca::apps
