// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam.hpp"
#include "io/logs/measurements.hpp"

namespace cca::apps {

/// What a mapping session had to do without, for people; empty where it lacked nothing: odometry,
/// a place in the map that it was to go on with, places of scans, poses near the others.
/// @param slam      the localiser's, null where there is none.
/// @param unguided  number of scans without odometry.
/// @param resumed   name of the map that the session was to go on with; empty: none.
/// @param origin    m, map frame: where the session's frame lies.
std::string sessionWarnings(const MappingSession& session, const Slam* slam, PoseSource pose,
                            std::size_t unguided, const std::string& resumed,
                            const Eigen::Vector2d& origin);

/// That there is no line, or why the scans contradict the map, or visits of one place one another;
/// empty where all is well.
std::string shortcomingOf(const MappingSession& session, const Slam* slam);

}  // namespace cca::apps
