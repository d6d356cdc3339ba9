// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// A log without the scans that are no evidence (see ScanFaults), of which it warns, and of poses
/// that no robot drives through, as millimetres that are taken for metres are. Of the motion
/// during a sweep, it adds what the log's poses tell, those of the next scan included; odometry
/// that scans have held is as of each scan first, see withoutHeldOdometry().
/// @param path  of a log that must hold a scan.
/// @throws std::runtime_error naming it where it holds none.
std::unique_ptr<LogReader> soundScansOf(std::unique_ptr<LogReader> log,
                                        const std::string& path = {});

}  // namespace cca
