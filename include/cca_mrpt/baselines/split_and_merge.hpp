// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca::baselines {

/// Split-and-Merge [Pavlidis & Horowitz 1974; Nguyen et al. 2007].
std::vector<LineSegment> splitAndMerge(const Scan& scan);

}  // namespace cca::baselines
