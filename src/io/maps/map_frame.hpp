// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/io/map_products.hpp"
#include "io/poses/pose_files.hpp"

namespace cca {

/// The trajectory with its times; empty where there are none.
std::vector<StampedPose> stampedPoses(const MapProducts& products);

}  // namespace cca
