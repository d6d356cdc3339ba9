// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

void LineMap::insert(const Scan&) {}
void LineMap::finishBatch() {}
std::vector<MapLine> LineMap::lines() const { return {}; }
std::vector<PolyLine> LineMap::polyLines() const { return {}; }

}  // namespace cca
