// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/world.hpp"

#include <stdexcept>

namespace cca {

World loadWorld(const std::string& yaml_path) {
  World world;
  if (!world.grid.loadFromROSMapServerYAML(yaml_path)) {
    throw std::runtime_error(yaml_path + ": cannot be read as a map_server map");
  }
  return world;
}

}  // namespace cca
