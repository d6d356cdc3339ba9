// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// What is in a log, as a JSON object in a fixed order: `scans`, `beams` (least and most a scan),
/// `field_of_view_deg`, `first_beam_deg`, `beam_step_deg`, `lasers` (mountings on the robot),
/// `returns`, `no_returns` and `invalid` (shares of the beams), `range_m` (shortest, median and
/// longest return), `noise_m` (median of what the scans tell of their own range noise),
/// `duration_s`, `time_faults` (`missing`, `backwards`, `repeated`, `gaps` of more than ten median
/// steps), `path_m`, `turning_deg`, `poses` (scans with corrected, odometry and true pose) and
/// `warnings`. Reads the log to its end; memory grows with the number of scans, not of beams.
nlohmann::ordered_json inspectLog(LogReader& log);

}  // namespace cca
