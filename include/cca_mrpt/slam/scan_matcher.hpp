// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

struct MatchResult;
struct PlacedSurface;
struct PoseBelief;
struct ScanSurface;

/// How a scan is matched to the key frames in view; see matchSurface().
using ScanMatcher = MatchResult (*)(const ScanSurface& query, const Pose2& start,
                                    const PoseBelief& prior,
                                    const std::vector<PlacedSurface>& references, double reach);

}  // namespace cca
