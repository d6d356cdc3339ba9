// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// A scan whose range noise is averaged over neighbouring beams, as far as one small patch of a
/// surface has them.
///
/// A beam is averaged with the pairs of beams at equal distance to its left and right whose ranges
/// lie on a line with its own, within 3 sigma: an inclined wall stays where
/// it is, a thin pole or an edge in front of others is not averaged away. Where the mean lies
/// clearly farther than the beam itself, the nearer side's mean is taken: an error is one to the
/// safe side. The patch is 3 cm to each side, and no larger than it takes to bring sigma down to 5
/// mm.
///
/// @param range_sigma  m, of the scan: see rangeNoise().
/// Cost: O(beams * patch); a scan of less noise than that is returned as it is.
Scan smoothScan(const Scan& scan, double range_sigma);

}  // namespace cca
