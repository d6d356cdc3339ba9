// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/line_map.hpp"
#include "locked.hpp"

namespace cca::python {

/// What Python knows as LineMap.
using SharedLineMap = Locked<LineMap>;

}  // namespace cca::python
