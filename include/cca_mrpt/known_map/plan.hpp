// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>

namespace cca {

using PlanLine = std::pair<Eigen::Vector2d, Eigen::Vector2d>;  ///< m, map frame: its two ends

/// How far a line of a map is off, as the map tells it: standard deviations in the map's frame.
struct LineSigma {
  double offset = 0.0;  ///< m, at its middle
  double angle = 0.0;   ///< rad
};

/// How much a localisation from anywhere works in one scan.
struct LocalisationEffort {
  int cells = 20000000;  ///< of the likelihood pyramid, looked up by the search: 40 ms
  int matches = 60;      ///< of a hypothesis to a view
};

}  // namespace cca
