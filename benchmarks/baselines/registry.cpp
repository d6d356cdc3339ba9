// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/registry.hpp"

#include <cmath>
#include <sstream>

#include "baselines/adaptive_fuzzy_clustering.hpp"
#include "baselines/convolution_clustering.hpp"
#include "baselines/expectation_maximisation.hpp"
#include "baselines/extended_split_and_merge.hpp"
#include "baselines/hough_transform.hpp"
#include "baselines/incremental.hpp"
#include "baselines/iterative_end_point_fit.hpp"
#include "baselines/kalman_grouping.hpp"
#include "baselines/line_regression.hpp"
#include "baselines/predicted_features.hpp"
#include "baselines/ransac.hpp"
#include "baselines/scan_regression.hpp"
#include "baselines/seeded_region_growing.hpp"
#include "baselines/split_and_merge.hpp"
#include "baselines/weighted_line_fitting.hpp"

namespace cca::baselines {
namespace {

/// Draws each described field, and writes down what it drew.
class Draw {
 public:
  explicit Draw(std::mt19937_64& random) : random_(random) {}

  void operator()(const char* name, double& value, double low, double high, const char*,
                  const char*) {
    value = low * std::pow(high / low, share());
    text_ << name << '=' << value << ' ';
  }
  void operator()(const char* name, int& value, int low, int high, const char*, const char*) {
    value = low + static_cast<int>(share() * (high - low + 1));
    text_ << name << '=' << value << ' ';
  }
  std::string text() const { return text_.str(); }

 private:
  double share() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }

  std::mt19937_64& random_;
  std::ostringstream text_;
};

template <class Parameters>
Baseline baseline(const char* name, const char* paper,
                  std::vector<LineSegment> (*extract)(const Scan&, const Parameters&)) {
  const auto with = [extract](const Parameters& p) {
    return Extractor([extract, p](const Scan& scan) { return extract(scan, p); });
  };
  const auto sample = [with](std::mt19937_64& random) {
    Parameters p;
    Draw draw(random);
    describe(p, draw);
    return Candidate{with(p), draw.text()};
  };
  return {name, paper, with(Parameters{}), with(Parameters::tuned()), sample};
}

}  // namespace

const std::vector<Baseline>& all() {
  static const std::vector<Baseline> baselines{
      baseline("split-and-merge", "Pavlidis & Horowitz 1974; Nguyen et al. 2007", &splitAndMerge),
      baseline("incremental", "Forsyth & Ponce 2003; Nguyen et al. 2007", &incremental),
      baseline("line-regression", "Arras & Siegwart 1997; Nguyen et al. 2007", &lineRegression),
      baseline("ransac", "Fischler & Bolles 1981; Nguyen et al. 2007", &ransac),
      baseline("hough", "Duda & Hart 1972; Nguyen et al. 2007", &houghTransform),
      baseline("expectation-maximisation", "Dempster et al. 1977; Nguyen et al. 2007",
               &expectationMaximisation),
      baseline("weighted-line-fitting", "Pfister et al. 2003", &weightedLineFitting),
      baseline("iterative-end-point-fit", "Duda & Hart 1973; Borges & Aldon 2004",
               &iterativeEndPointFit),
      baseline("convolution-clustering", "Fernandez et al. 2010", &convolutionClustering),
      baseline("seeded-region-growing", "Gao et al. 2018", &seededRegionGrowing),
      baseline("adaptive-fuzzy-clustering", "Ip et al. 2002; the paper's [14]",
               &adaptiveFuzzyClustering),
      baseline("extended-split-and-merge", "the paper's [13]", &extendedSplitAndMerge),
      baseline("scan-regression", "the paper's [8]", &scanRegression),
      baseline("predicted-features", "Zhao & Chen 2011; the paper's [18]", &predictedFeatures),
      baseline("kalman-grouping", "Zhang, Xie & Adams; the paper's [12]", &kalmanGrouping),
  };
  return baselines;
}

}  // namespace cca::baselines
