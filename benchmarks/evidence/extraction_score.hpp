// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "evidence/labelled_scan.hpp"

namespace cca::evidence {

/// A true edge that was found, and how far its segment lies from it: m, rad.
struct EdgeMatch {
  std::size_t edge = 0;
  double lateral = 0.0, angular = 0.0;
};

/// How well segments describe one scan. What is not defined (the precision of no segment, the F1
/// without truth) has no value. Distances in m, angles in rad.
struct ExtractionScore {
  double segments = 0.0;
  double explained = 0.0;              ///< share of returned rays met within 0.1 m
  double explained_per_segment = 0.0;  ///< such rays for each segment; 0 where there is none
  double blocked = 0.0;                ///< share of rays that pass a segment by more than 0.1 m
  std::optional<double> range_rmse;    ///< over returned rays that meet a segment
  std::optional<double> precision, recall, f1, covered;
  std::optional<double> lateral, angular;  ///< mean error over the matches
  std::vector<EdgeMatch> matches;
};

/// Range at which each ray meets the segments first; infinity where it meets none.
std::vector<double> predictedRanges(const Scan& scan, const std::vector<LineSegment>& segments);

/// Precision and recall count one-to-one matches: less than 5 degrees apart, the segment's midpoint
/// within 0.1 m of the edge's line, overlap at least half of both; longest overlaps first. Edges
/// with fewer than 5 rays need not be found, and a segment on one of them counts neither way.
/// `covered` is the share of all edges' length with a segment within 5 degrees and 0.1 m.
ExtractionScore scoreExtraction(const LabelledScan& truth,
                                const std::vector<LineSegment>& segments);

}  // namespace cca::evidence
