// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "evaluation/spatial_index.hpp"

namespace cca {

/// Segments from CSV, rows x1,y1,x2,y2 (metres; more columns may follow) by comma, semicolon or
/// blank (by semicolon, with decimal commas or points): true ones, or those of a map. The first row
/// may be a header that tells by these names which columns they are; lines that begin with # are
/// comments.
/// @throws std::runtime_error naming file and line, also for places beyond 10 000 km and segments
///         beyond 100 km, and for a file without header and rows.
std::vector<Segment2> loadSegments(const std::string& csv_path);
/// The same of a text. @param name  of the file, for messages.
std::vector<Segment2> readSegments(const std::string& text, const std::string& name);

/// Where the true segments of a world stand: WORLD.truth.csv beside WORLD.yaml.
std::string truthPath(const std::string& yaml_path);

}  // namespace cca
