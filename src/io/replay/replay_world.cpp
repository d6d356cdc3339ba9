// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <nlohmann/json.hpp>

#include "cca_mrpt/simulation/world.hpp"
#include "io/replay/replay.hpp"

namespace cca {

using Json = nlohmann::ordered_json;

/// Lengths of runs: free, not free, free, ..., row by row from the lowest y.
std::string replayWorld(const World& world) {
  Json runs = Json::array();
  bool is_obstacle = false;
  std::int64_t length = 0;
  for (const unsigned char cell : world.obstacles()) {
    if ((cell != 0) != is_obstacle) {
      runs.push_back(length);
      length = 0;
      is_obstacle = !is_obstacle;
    }
    ++length;
  }
  runs.push_back(length);
  return Json{{"width", world.width()},           {"height", world.height()},
              {"resolution", world.resolution()}, {"x", world.origin().x()},
              {"y", world.origin().y()},          {"runs", runs}}
      .dump();
}

}  // namespace cca
