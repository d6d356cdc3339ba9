// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cca_mrpt/simulation/building.hpp"

namespace cca {

/// The kinds of building that generateBuilding() knows; `crowded` is not among the shipped ones.
std::vector<std::string> buildingKinds();

/// A building of a kind; the seed varies its furniture, or all of it (maze, random, crowded).
///
/// Every door and every passage between pieces of furniture is at least 0.9 m wide, so that all of
/// the floor is one region for a robot of 0.25 m radius with a margin of 0.1 m; but in `crowded`,
/// where any gap may be anything, half a metre around the start is all that is kept free.
/// @throws std::runtime_error for an unknown kind, naming those that there are.
Building generateBuilding(const std::string& kind, std::uint64_t seed);

}  // namespace cca
