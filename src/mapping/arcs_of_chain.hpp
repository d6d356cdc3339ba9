// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/geometry/arc.hpp"

namespace cca {

/// What it means for a chain to be seen from one place, the origin.
struct OneView {
  std::optional<Limbs> limbs;  ///< of the whole chain, where it stands free
};

/// A link of a chain: neighbouring points that were told as one line, or as points on none.
struct ChainLink {
  int first = 0, last = 0;  ///< points first <= i < last of the chain
  bool is_line = false;
};

/// Arcs in place of links that follow one another, where that tells the points more briefly: an arc
/// is a line with a bulge, and all of it is seen from one side.
///
/// @param links  in order, without gaps between their points.
/// @param least_bulge  m; what stands off its chord by less is no arc.
/// @param vertex_price  nats, > 0; what an arc costs is in proportion to it.
/// @param view   none where the chain was seen from many places. A pillar that stands free needs no
///               price for its ends.
/// @return  arcs in the order of the links, each with the links first <= k < last that it is taken
/// for.
/// Cost: O(points x links) fits at worst.
struct ArcOfLinks {
  Arc arc;
  int first = 0, last = 0;
};
std::vector<ArcOfLinks> arcsOfChain(const std::vector<CurvePoint>& points,
                                    const std::vector<ChainLink>& links, double least_bulge,
                                    double vertex_price, const OneView* view = nullptr);

}  // namespace cca
