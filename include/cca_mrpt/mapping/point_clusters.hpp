// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/ablation.hpp"
#include "cca_mrpt/mapping/description_length.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// Point clusters of a scan: K-means with K = round(N / points_per_cluster), then pruning.
///
/// Pruning: a cluster falls into runs of neighbouring points without an inner gap; a run whose
/// points do not lie on one line within the noise is split by 2-means until all do.
/// An inner gap is a beam without return or a step in depth (ScanPoints::breaks): without that test
/// three points across a step always make a line.
/// @return  runs in scan order that cover all points, each with the line that pruning fitted to it.
/// Cost: O(N) for K-means; O(k^2) to prune a cluster of k points, k being bounded by the parameter.
std::vector<FittedRun> pointClusters(const ScanPoints& points, const RunFitter& fitter,
                                     int points_per_cluster, const Ablation& without = {});

}  // namespace cca
