// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_extraction.hpp"

namespace cca {

std::vector<LineSegment> extractLines(const Scan&, const CcaParameters&) { return {}; }

}  // namespace cca
