// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "cca_mrpt/io/icp_localiser.hpp"
#include "io/logs/measurements.hpp"

namespace cca {

/// The localiser of a source; for given poses, the log's or the truth, one that believes them.
std::unique_ptr<Localiser> makeLocaliser(PoseSource source, const IcpParameters& icp = {});

}  // namespace cca
