// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/mapping/ablation.hpp"
#include "mapping/description_length.hpp"

namespace cca {

/// Rays that speak against a wall, at which mu_3 is one half: one is as much as a wall can bear.
inline constexpr double kGapGate = 1.0;

/// A membership of the bell shape, 1 / (1 + evidence / gate): 1 without evidence against, 1/2 at
/// the gate, 0 for infinite evidence.
/// @param evidence  at least 0. @param gate  positive.
inline double bell(double evidence, double gate) { return gate / (gate + evidence); }

/// How far two lines are of one wall: five fuzzy memberships, each in [0, 1].
///
/// Each is a bell(), 1 for a perfect match and 1/2 where the evidence against one wall equals what
/// one line less saves, or what chance explains: at similarity_cut = 1/2 two are alike where one
/// line tells them better. No width is set: all come from the noise of the scan and of the map.
///
/// One line in the place of two lets the residuals grow. In a scan, whose beams err each by itself,
/// fit asks for the whole growth. In the map, whose scans err in their poses, it parts: orientation
/// and offset ask for the shares that turn and shift explain, each by its own variance.
struct Memberships {
  double orientation = 0.0;  ///< mu_1: the angle between them, against its standard deviation
  double offset = 0.0;       ///< mu_2: centroids off the other's extended line, likewise
  double gap = 0.0;          ///< mu_3: rays that speak against a wall between the two, its length
  double fit = 0.0;          ///< mu_4: what their points lie off the common line
  double overlap = 0.0;  ///< mu_5: where they lie side by side, they lie on each other: parallel
                         ///< walls and the two faces of a thin one stay two

  /// The t-norm of the five, min.
  double similarity() const;
};

/// When two are one: where the least of their memberships reaches a cut.
struct AlphaCut {
  double value;      ///< (0, 1]
  Ablation without;  ///< memberships left out count as 1

  AlphaCut(double cut, Ablation left_out = {}) : value(cut), without(left_out) {}
  explicit AlphaCut(const CcaParameters& p) : AlphaCut(p.similarity_cut, p.without) {}
  double similarity(const Memberships& mu) const;
};

/// mu_4 alone: the cheapest, and the first to fail.
/// @param joint  fit of the points of both.
/// @param line_price  nats, > 0: see linePrice().
double fitMembership(const FittedSegment& a, const FittedSegment& b, const FittedSegment& joint,
                     double line_price);

/// Of two pieces of a scan. Orientation and offset are 1, for what they would ask is in the fit; so
/// is overlap, for from one place no two are seen side by side.
/// @param joint        fit of the points of both.
/// @param gap_evidence rays, >= 0: that pass where the joint line is, or end before it unexplained.
Memberships memberships(const FittedSegment& a, const FittedSegment& b, const FittedSegment& joint,
                        double gap_evidence, double line_price);

/// The Similarity Index Matrix: symmetric, in [0, 1], unit diagonal, 0 where nothing is set.
class SimilarityMatrix {
 public:
  struct Entry {
    int row = 0;  ///< < column
    int column = 0;
    double value = 0.0;
  };

  explicit SimilarityMatrix(int size) : size_(size) {
    entries_.reserve(2 * static_cast<std::size_t>(size));
  }
  /// @param i, j  different, in 0..size-1, each pair set once at most.
  void set(int i, int j, double value) {
    if (value > 0.0) entries_.push_back({i < j ? i : j, i < j ? j : i, value});
  }
  int size() const { return size_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  int size_;
  std::vector<Entry> entries_;
};

}  // namespace cca
