// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/geometry/arc.hpp"
#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/sensing/analysed_scan.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// The lines of one scan by the Consecutive Clustering Algorithm (the paper's steps 2 to 5):
/// noise from the scan itself, K-means point clusters, pruning, segments, similarity by five fuzzy
/// memberships, Rank Order Clustering, merge and repeat, poly-lines.
///
/// Each segment stands on at least three returns, ends where its outermost rays meet it, or at the
/// corner that it shares, to the last bit, with its neighbour; start precedes end
/// counter-clockwise. Its moments are those of its own returns; a return belongs to one segment at
/// most. No ray that passed or did not come back crosses it, but for the noise at its corners.
///
/// @param scan  any; fewer than three returns give no line.
/// @return      segments in the sensor frame (T_map_sensor is not used), counter-clockwise, of
///              positive length.
/// Cost: O(N) for N beams, plus O(n^2) for n lines.
std::vector<LineSegment> extractLines(const Scan& scan, const CcaParameters& parameters = {});

/// The noise of a scan, the lines of extractLines(), and the arcs of extractFeatures() that are
/// curved walls: where three lines or more, one behind another, turn the same way.
/// Cost: that of extractLines(), and O(n) circle fits for each chain of n such lines.
AnalysedScan analyse(Scan scan, const CcaParameters& parameters = {});

/// What a scan shows, sensor frame. An arc stands for lines that are there as well, its chords.
struct ScanFeatures {
  std::vector<LineSegment> lines;
  std::vector<Arc> arcs;
};

/// The lines of extractLines(), and the arcs that tell some of them more briefly: round pillars,
/// curved walls (see arcsOfChain()).
/// Cost: that of extractLines(), and O(n) circle fits for each chain of n lines.
ScanFeatures extractFeatures(const Scan& scan, const CcaParameters& parameters = {});

}  // namespace cca
