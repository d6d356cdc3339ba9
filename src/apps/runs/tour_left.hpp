// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cca::apps {

/// About how far a robot has to drive until it has been at all of these places: it goes to the
/// nearest next, straight, and a building makes that a third longer. For people.
/// @param places  m, thinned out to one in two metres. @return m. Cost: O(n^2) for what remains.
double tourLeft(const Eigen::Vector2d& p_robot, const std::vector<Eigen::Vector2d>& places);

}  // namespace cca::apps
