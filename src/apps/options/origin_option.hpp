// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "cca_mrpt/io/geo_reference.hpp"

namespace cca::apps {

/// --origin. @param place  set where it is given; outlives the command. @param what  "FILE is".
inline void addOriginOption(CLI::App& command, std::optional<GeoReference>& place,
                            const std::string& what) {
  command
      .add_option_function<std::string>(
          "--origin",
          [&place](const std::string& text) {
            try {
              place = geoReferenceOf(text);
            } catch (const std::runtime_error& error) {
              throw CLI::ValidationError("--origin", error.what());
            }
          },
          "where (0, 0) of the map lies, and how far its x axis is turned from east to the left, "
          "degrees: " +
              what + " in longitude and latitude then")
      ->type_name("LAT,LON[,DEG]");
}

}  // namespace cca::apps
