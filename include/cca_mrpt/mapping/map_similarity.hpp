// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/similarity.hpp"

namespace cca {

/// The five memberships of two lines of the map frame, whose covariances hold the pose error.
///
/// As within a scan, each is a bell that stands at 1/2 at its gate; but there the evidence is
/// weighed in points, which share one pose, and here in lines, which do not. mu_1, mu_2 and mu_4
/// have their gates at the 99.9 % quantile of what noise and pose error alone would give; mu_5 does
/// not ask whether the two lie side by side, for a second look at a wall does: it asks whether they
/// show their faces to the same side.
///
/// @param gap         >= 0, stretch between the two over the longest that is closed.
/// @param same_facing whether both can be the same face.
Memberships mapMemberships(const LineSegment& a, const LineSegment& b, double gap,
                           bool same_facing);

}  // namespace cca
