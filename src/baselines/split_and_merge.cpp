// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/baselines/split_and_merge.hpp"

namespace cca::baselines {

std::vector<LineSegment> splitAndMerge(const Scan&) { return {}; }

}  // namespace cca::baselines
