// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/ablation.hpp"
#include "cca_mrpt/mapping/description_length.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// Mean size of a point cluster as K-means makes it. Later steps move every boundary: F1 of single
/// scans is the same within 0.002 for 3 to 18 (docs/log/tuning.md), and eight take the least time.
inline constexpr int kPointsPerCluster = 8;

/// Point clusters of a scan: K-means with K = round(N / kPointsPerCluster), then pruning.
///
/// Pruning: a cluster falls into runs of neighbouring points without an inner gap; a run whose
/// points do not lie on one line within the noise is split by 2-means until all do.
/// An inner gap is a beam without return or a step in depth (ScanPoints::breaks): without that test
/// three points across a step always make a line.
/// @return  runs in scan order that cover all points, each with the line that pruning fitted to it.
/// Cost: O(N) for K-means; O(k^2) to prune a cluster of k points, some kPointsPerCluster.
std::vector<FittedRun> pointClusters(const ScanPoints& points, const RunFitter& fitter,
                                     const Ablation& without = {});

}  // namespace cca
