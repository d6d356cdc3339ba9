// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// A log without the scans that are no evidence (see ScanFaults), of which it warns, and whose
/// scans are brought to one instant each, see MotionCompensation; by its odometry, else by its
/// corrected poses. A first pass finds out how each laser sweeps, so that the first scans of a log
/// are undone as the last ones.
/// @param open   opens the log anew, for the first pass.
/// @param sweep  s, of each laser's sweep, with its sign; nothing: is to be found out.
std::unique_ptr<LogReader> undistorted(std::unique_ptr<LogReader> log,
                                       const std::function<std::unique_ptr<LogReader>()>& open,
                                       const std::optional<double>& sweep);

}  // namespace cca
