// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/navigation/view_points.hpp"

namespace cca {

/// How the next goal is chosen.
enum class Strategy { kGreedy, kNearestFrontier, kGainDistance, kViewTour };

/// @throws std::runtime_error for a name that is none.
Strategy strategyNamed(const std::string& name);

/// Index of the best view point; empty for no view points. Ties: the first.
std::optional<std::size_t> selectGoal(Strategy strategy, const std::vector<ViewPoint>& view_points);

}  // namespace cca
