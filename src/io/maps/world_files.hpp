// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cca_mrpt/simulation/building.hpp"

namespace cca {

/// Cell side of the worlds that are generated.
constexpr double kWorldResolution = 0.05;  // m

/// Writes a plan as a world: FOLDER/NAME.yaml and NAME.png (map_server), and NAME.truth.csv with
/// the true wall faces, header `x1,y1,x2,y2` (m, map frame). Same plan, same bytes.
/// @throws std::runtime_error naming the file that cannot be written, or for a name that is not of
///         plain letters, digits, '_', '-' and '.'.
void writeWorldFiles(const Building& plan, const std::string& folder);

}  // namespace cca
