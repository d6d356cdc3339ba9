// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "known_map/plan_lines.hpp"

namespace cca {

/// m, from a point along a bearing [rad] to the first line; +inf beyond `longest` [m].
/// Cost: pieces near the cells that the ray crosses.
double rangeInPlan(const PlanLines& plan, const Eigen::Vector2d& p_map, double bearing,
                   double longest);

/// What a laser would see of a plan from all over the part of it that the robot gets to: whoever
/// learns ways from scans knows those of the plan by them. Each place is in sight of another one
/// that is kPlannedSightSpacing away, about.
/// @param start      m, where the robot stands; it keeps off the lines by `clearance` [m, at most
///                   PlanLines::kMostReach] elsewhere.
/// @return           scans of one instant all around; beams that meet no line say nothing.
/// Cost: grows with the area within.
std::vector<Scan> plannedSights(const PlanLines& plan, const Eigen::Vector2d& start,
                                double clearance);
/// m, between two of them: a room has one, however small.
inline constexpr double kPlannedSightSpacing = 1.5;

}  // namespace cca
