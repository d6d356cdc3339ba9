// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "baselines/registry.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "evidence/extraction_score.hpp"
#include "evidence/statistics.hpp"

namespace cca::evidence {

/// An extractor with one set of parameters, as it enters the comparison.
struct Contender {
  std::string name;
  std::string parameters;  ///< "shipped", "recommended" or "tuned"
  baselines::Extractor extract;
};

/// CCA, and each baseline with both its sets of parameters.
std::vector<Contender> contenders(const CcaParameters& cca);

/// Scans that are averaged together: simulated ones at one noise, or real ones.
struct ScanGroup {
  std::string name;          ///< "simulated" or "real"
  double range_noise = 0.0;  ///< m; 0 for real ones
  std::vector<LabelledScan> scans;
};

/// One contender's score on one scan.
struct Trial {
  ExtractionScore score;
  double microseconds = 0.0;
};

/// A figure of the table: its name in files, its heading, and how it is read from a trial.
struct Figure {
  std::string name, heading;
  std::function<std::optional<double>(const Trial&)> of;
  int decimals = 3;
  double scale = 1.0;      ///< of the table, against SI units in files
  bool is_median = false;  ///< median over scans, not mean
};
const std::vector<Figure>& figures();

/// Runs a contender on each scan. Times are of this thread, wall clock, the extraction alone.
std::vector<Trial> run(const Contender& contender, const std::vector<LabelledScan>& scans);

/// Mean (or median) and 95 % interval of a figure over the trials that have it; nothing where none
/// has.
std::optional<BootstrapEstimate> summarise(const std::vector<Trial>& trials, const Figure& figure);

/// Theirs minus ours, scan by scan: what the scans have in common drops out, so that the intervals
/// are narrower than those of the two means. Nothing where no scan has both.
std::optional<BootstrapEstimate> f1Difference(const std::vector<Trial>& theirs,
                                              const std::vector<Trial>& ours);
/// Lateral error [m], theirs minus ours, on the edges that both have found: the mean error over
/// one's own matches flatters whoever finds only the long and easy ones.
std::optional<BootstrapEstimate> lateralDifference(const std::vector<Trial>& theirs,
                                                   const std::vector<Trial>& ours);

/// The best of `draws` random sets of parameters for a baseline, by mean F1 over the scans; the
/// recommended and the tuned set stand for election too.
struct Fit {
  std::string parameters;
  double f1 = 0.0;
};
Fit fitParameters(const baselines::Baseline& baseline, const std::vector<LabelledScan>& scans,
                  int draws, std::uint64_t seed);

}  // namespace cca::evidence
