// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// Reads an MRPT .rawlog, zipped or not, of either kind: action-observation pairs, whose actions
/// are summed up to odometry, or plain observations, where the odometry is interpolated to the time
/// of each scan. Observations of other sensors are passed over. Scans without time stamp carry the
/// action's, else none.
std::unique_ptr<LogReader> openRawlog(const std::string& path);

/// Reads an MRPT .simplemap, zipped or not: scans at the poses that a SLAM program stored.
std::unique_ptr<LogReader> openSimpleMap(const std::string& path);

}  // namespace cca
