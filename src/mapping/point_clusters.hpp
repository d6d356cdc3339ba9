// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/ablation.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "mapping/description_length.hpp"

namespace cca {

/// Mean size of a point cluster before K-means. Later steps move every boundary: F1 of single scans
/// is the same within 0.002 for 3 to 18 (docs/log/tuning.md), and eight take the least time.
inline constexpr int kPointsPerCluster = 8;

/// Point clusters of a scan: K-means with K = round(N / kPointsPerCluster) and what pruning adds.
///
/// It begins with equal shares of the sequence, parted where there is an inner gap: a beam without
/// return or a step in depth (ScanPoints::breaks); without that test three points across a step
/// always make a line. Pruning: a share whose points do not lie on one line within the noise is
/// split by 2-means of its points until all do. From there kMeans() moves the boundaries.
/// @return  runs in scan order that cover all points, each with its line.
/// Cost: O(N); O(k^2) to prune a share of k points, some kPointsPerCluster.
Runs pointClusters(const ScanPoints& points, const RunFitter& fitter, const Ablation& without = {});

}  // namespace cca
