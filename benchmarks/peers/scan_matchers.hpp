// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/slam/slam.hpp"
#include "slam/surface_matching.hpp"

namespace cca::peers {

/// A published scan matcher in place of ours, in the same graph with the same searches.
struct ScanMatcher {
  std::string name;
  std::string source;
  cca::ScanMatcher match;
};

/// Ours, PL-ICP, and those that the paper's introduction names: IDC [6] and weighted matching [9].
const std::vector<ScanMatcher>& scanMatchers();

/// Iterative Dual Correspondence [Lu and Milios 1997]: of the nearest points the shift, of the
/// points at the same range within a shrinking window of bearings the turn.
MatchResult matchByDualCorrespondence(const ScanSurface& query, const Pose2& start,
                                      const PoseBelief& prior,
                                      const std::vector<PlacedSurface>& references, double reach);

/// Weighted matching [Pfister et al. 2002]: nearest points, each pair weighed by the covariance of
/// both ends: noise of range and bearing, and what lies between two beams on a surface seen at its
/// incidence. A reconstruction: the incidence is that of the returns' normals.
MatchResult matchWeighted(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                          const std::vector<PlacedSurface>& references, double reach);

/// PL-ICP [Censi 2008]: distances to the line through the two nearest points, the worst tenth left
/// out.
MatchResult matchPointToLine(const ScanSurface& query, const Pose2& start, const PoseBelief& prior,
                             const std::vector<PlacedSurface>& references, double reach);

}  // namespace cca::peers
