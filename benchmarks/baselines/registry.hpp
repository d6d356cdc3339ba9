// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <random>  // seeded by the caller
#include <string>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca::baselines {

using Extractor = std::function<std::vector<LineSegment>(const Scan&)>;

/// An extractor whose parameters were drawn at random.
struct Candidate {
  Extractor extract;
  std::string parameters;  ///< name=value, separated by blanks
};

/// A classical line extractor: comparing them is a loop over all().
struct Baseline {
  std::string name;       ///< as in tables and files
  std::string paper;      ///< where it was published
  Extractor recommended;  ///< with the values that its source recommends
  Extractor tuned;        ///< with the best values known for indoor scans
  /// Parameters drawn from their described ranges, evenly on the scale of their logarithms.
  std::function<Candidate(std::mt19937_64&)> sample;
};

/// All baselines, in a fixed order.
const std::vector<Baseline>& all();

}  // namespace cca::baselines
