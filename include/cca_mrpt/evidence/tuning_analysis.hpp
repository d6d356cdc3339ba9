// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/evidence/analysis_of_variance.hpp"
#include "cca_mrpt/evidence/statistics.hpp"
#include "cca_mrpt/evidence/tuning_design.hpp"

namespace cca::evidence {

/// What is to be made large.
enum class Objective {
  kScan,  ///< F1 of single scans
  kMap,   ///< F1 of the map's length
  kBoth,  ///< the mean of the two
};

/// Analysis of variance of the three parameters, their interactions of two, and the scenes as
/// blocks. Only scenes of which every combination has run are used.
/// @throws std::runtime_error where there are too few of them.
AnalysisOfVariance analyseTuning(const TuningDesign& design, const std::vector<TuningRow>& rows,
                                 Objective objective);

/// Mean of the objective over scenes for one combination, with its interval.
struct Combination {
  CcaParameters parameters;
  Estimate value;
};
std::vector<Combination> combinationMeans(const TuningDesign& design,
                                          const std::vector<TuningRow>& rows, Objective objective);

/// The best combination; how far resampled scenes would move it; and how the shipped one compares.
struct Recommendation {
  CcaParameters best;
  double best_value = 0.0;
  struct Interval {
    double low = 0.0, high = 0.0;
  };
  Interval similarity_cut, vertex_price, straightness;  ///< 95 %, bootstrap over scenes
  double shipped_value = 0.0;  ///< 0 where the design does not hold the shipped combination
  Estimate shortfall;          ///< best minus shipped, scene by scene
  bool shipped_in_design = false;
};
Recommendation recommend(const TuningDesign& design, const std::vector<TuningRow>& rows,
                         Objective objective, const CcaParameters& shipped = {});

}  // namespace cca::evidence
