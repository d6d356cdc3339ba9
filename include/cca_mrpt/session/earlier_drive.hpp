// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"

namespace cca {

/// Lets a session go on with what an earlier drive has left, before its first scan.
/// @param slam  the localiser of that session.
void rememberDrive(const SlamMemory& memory, SlamLocaliser& slam, MappingSession& session);

/// Makes one map of what several drives of one place have left, in the frame of the first: the
/// others begin as they were, and look for their place in it. Finishes the session.
/// @param drives  one or more. @param slam  the localiser of that session, which has no scans yet.
/// @param do_all  see MappingSession::finish().
/// @return  the first of the drives of which no place was found in the first; nothing where all
///          were.
std::optional<std::size_t> joinDrives(const std::vector<const SlamMemory*>& drives,
                                      SlamLocaliser& slam, MappingSession& session,
                                      const DoAll& do_all = doInTurn);

}  // namespace cca
