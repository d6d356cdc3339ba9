// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/world_generator.hpp"

#include <stdexcept>

#include "simulation/building_kinds.hpp"

namespace cca {

namespace {

const std::vector<std::pair<std::string, Building (*)(Random&)>> kKinds = {
    {"two_rooms", twoRooms},
    {"office", office},
    {"apartment", apartment},
    {"warehouse", warehouse},
    {"corridor_loop", corridorLoop},
    {"pillar_hall", pillarHall},
    {"gallery", gallery},
    {"maze", maze},
    {"random", randomBuilding},
    {"crowded", crowdedBuilding},
};

}  // namespace

std::vector<std::string> buildingKinds() {
  std::vector<std::string> names;
  for (const auto& [name, make] : kKinds) names.push_back(name);
  return names;
}

Building generateBuilding(const std::string& kind, std::uint64_t seed) {
  std::string known;
  for (const auto& [name, make] : kKinds) {
    known += (known.empty() ? "" : ", ") + name;
    if (name != kind) continue;
    Random random(seed);
    Building plan = make(random);
    plan.name = name;
    return plan;
  }
  throw std::runtime_error("'" + kind + "' is no kind of world, there are: " + known);
}

}  // namespace cca
