// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"

namespace cca {

/// How far two segments are of one wall: five fuzzy memberships, each in [0, 1].
///
/// Each is a bell 1 / (1 + z^2 / gate): 1 for a perfect match, 1/2 where the statistic z^2 stands
/// at its gate, the 99.9 % quantile of what noise alone would give.
struct Memberships {
  double orientation = 0.0;  ///< mu_1: angle between them, against their orientation deviations
  double offset = 0.0;       ///< mu_2: distance of each centroid from the other's extended line
  double gap = 0.0;          ///< mu_3: what lies between them speaks for one wall
  double fit = 0.0;          ///< mu_4: growth of the residuals when one line replaces the two
  double overlap = 0.0;      ///< mu_5: they do not lie side by side

  /// The t-norm of the five, min.
  double similarity() const;
};

/// @param gap_evidence  >= 0, the statistic of mu_3: missing points (or rays that passed) between.
Memberships memberships(const LineSegment& a, const LineSegment& b, double gap_evidence);

/// The Similarity Index Matrix: symmetric, in [0, 1], unit diagonal; row by row.
class SimilarityMatrix {
 public:
  explicit SimilarityMatrix(int size)
      : size_(size), values_(static_cast<std::size_t>(size) * size, 0.0) {
    for (int i = 0; i < size; ++i) set(i, i, 1.0);
  }
  int size() const { return size_; }
  double operator()(int i, int j) const { return values_[index(i, j)]; }
  void set(int i, int j, double value) { values_[index(i, j)] = values_[index(j, i)] = value; }

 private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(j);
  }
  int size_;
  std::vector<double> values_;
};

}  // namespace cca
