// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/line_merging.hpp"

namespace cca {

/// Re-assigns the points around corners until nothing moves; each step lowers the description
/// length of the scan, so that it ends.
///
/// Clusters end where K-means put them, not where walls do. So, in turn: the boundary between two
/// neighbours moves to its best place; a run is shared out between its two neighbours; a line falls
/// apart at its best corner; loose points in a row form the lines that hide among them.
/// @return  true where a point changed its run.
bool refineCorners(const ScanPoints& points, const RunFitter& fitter, Runs* runs);

}  // namespace cca
