// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/geometry/arc.hpp"
#include "cca_mrpt/mapping/line_merging.hpp"

namespace cca {

/// The arcs of a scan (sensor frame): those that tell runs without a break between them more
/// briefly than lines do, see arcsOfChain().
///
/// @param runs   as they stand when the scan's lines are told from them.
/// @param noise  of the scan.
/// @param vertex_price  nats, > 0.
std::vector<Arc> arcsOfScan(const ScanPoints& points, const Runs& runs, PointNoise noise,
                            double vertex_price);

}  // namespace cca
