// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/io/log_reader.hpp"
#include "evaluation/log_score.hpp"

namespace cca::apps {

/// A map that is judged.
struct JudgedMap {
  /// @param lines_csv  the text of its lines.csv, or of any file of segments.
  /// @param name       of that file, for messages.
  /// @throws std::runtime_error naming the file and the reason; lines of single scans stand in the
  ///         frames of their sensors, and are no map.
  JudgedMap(std::string lines_csv, std::string name);

  std::string text, name;
  std::vector<Segment2> segments;
};

/// Against the scans that it was made from, whose motion is undone (see undistortedLog()).
LogScore judgeByLog(LogReader& log, const JudgedMap& map);

/// Against the true world, and its standard deviations against its errors.
/// @param world  a .yaml; NAME.truth.csv stands beside it.
LogScore judgeByWorld(const std::string& world, const JudgedMap& map);

/// As JSON, of five digits behind the point; null where a figure does not exist.
std::string textOf(const LogScore& score);

}  // namespace cca::apps
