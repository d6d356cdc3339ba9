// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"

namespace cca {

/// Lets a session go on with what an earlier drive has left, before its first scan.
/// @param slam  the localiser of that session.
void rememberDrive(const SlamMemory& memory, SlamLocaliser& slam, MappingSession& session);

}  // namespace cca
