// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/sensing/scan.hpp"
#include "mapping/description_length.hpp"

namespace cca {

/// Points by which a boundary may move in one sweep.
inline constexpr int kBoundaryReach = 5;

/// K-means with K = 2 of a run of points, exactly: where to part first..last between low and high,
/// both included, so that two means tell its points most briefly; either is a line or, where that
/// is cheaper, its points as they are.
/// @param price  nats; -1 is returned where no parting costs less.
/// Cost: O(high - low).
int twoMeans(const RunFitter& fitter, int first, int low, int high, int last, double price);

/// K-means [Lloyd 1982] whose means are lines [k-plane clustering: Bradley & Mangasarian 2000], of
/// points that are seen in order of bearing.
///
/// The clusters of points in order are runs, and to assign points is to move the boundaries between
/// them: each in turn goes to where the two means beside it, fitted anew, tell the points of both
/// most briefly, by kBoundaryReach points at most; and again, until none moves. Each step lowers
/// the description length of the scan, so that it ends. No point crosses a beam without return or a
/// step in depth.
/// @param worth  nats, > 0, that a move must save.
/// @return  true where a point changed its cluster; clusters that run empty are gone.
/// Cost: O(1) for each boundary of which a cluster has changed since it was last asked.
bool kMeans(const ScanPoints& points, const RunFitter& fitter, Runs* runs, double worth = kNoGain);

}  // namespace cca
