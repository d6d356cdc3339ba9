// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/support_bin.hpp"

namespace cca {

/// A maximal occupied run of bins.
struct Stretch {
  BinRange range;
  BinTally tally;
};

/// The 1-D occupancy histogram along a wall.
///
/// What is asked of all bins is remembered, and kept up to date hit by hit: a scan that says
/// nothing new about a wall costs what its own returns cost, not what the wall is long.
class SupportProfile {
 public:
  static constexpr double kBinLength = 0.05;  ///< m
  static int binOf(double t) {
    const double x = t / kBinLength;
    const int i = static_cast<int>(x);  // towards zero; std::floor is a call on a plain x86-64
    return x < i ? i - 1 : i;
  }

  bool empty() const { return bins_.empty(); }
  int first() const { return first_; }
  int last() const { return first_ + static_cast<int>(bins_.size()); }
  const SupportBin& bin(int i) const { return bins_[static_cast<std::size_t>(i - first_)]; }
  bool contains(int i) const { return i >= first() && i < last(); }

  /// A return at (t, d); the profile grows to hold it. @return its bin, until the next change.
  const SupportBin& hit(double t, double d);
  /// A ray went through at t; outside the profile this says nothing and costs nothing. True where
  /// prune() or stretches() may have another result now.
  bool pass(double t, double rays = 1.0);
  /// Another profile's bin, already in this frame.
  void add(const SupportBin& bin);
  /// Empties a bin and returns what it held.
  SupportBin take(int i);
  /// Cuts [from, last()) off and returns it.
  SupportProfile cutFrom(int from);
  /// Whether rays may have refuted a bin since the last prune().
  bool mayBeRefuted() const { return refuted_; }
  /// Forgets bins that rays have refuted, and empty ends. True where something went.
  bool prune();

  /// Hits minus refuted ones within +-kWindow bins decide whether a place is occupied.
  bool occupied(int i) const;
  /// Maximal occupied runs; gaps up to kBridgedBins are closed where no ray went through them.
  static constexpr int kBridgedBins = 4;  // longer gaps without hits would be phantoms
  const std::vector<Stretch>& stretches() const;

  const BinTally& tally() const;
  BinTally tally(const BinRange& range) const;
  const BinSums& sums() const { return tally().fitted; }
  LateralFit fit() const { return sums().fit(); }
  /// The cut that lowers the residual sum of squares most.
  struct Cut {
    int at = 0;
    double gain = 0.0;  ///< m^2
  };
  Cut bestCut() const;

 private:
  void grow(int i);
  void forget() const { tallied_ = parted_ = open_ = false; }
  /// Enters into what is remembered what the open bin has received.
  void settle() const;
  Stretch* stretchAt(int i) const;
  /// What decides whether a place is occupied.
  struct Counts {
    double hits = 0.0, passed = 0.0;
    bool stand() const;
  };
  Counts countsAround(int i) const;
  /// Whether what is new in bin i occupies or frees a place.
  bool movesPlace(int i, double new_hits, double new_rays) const;
  SupportBin& at(int i) { return bins_[static_cast<std::size_t>(i - first_)]; }

  int first_ = 0;
  std::vector<SupportBin> bins_;
  bool refuted_ = false;                           ///< a bin may have been since the last prune()
  mutable bool tallied_ = false, parted_ = false;  ///< tally_ holds; stretches_ does
  /// Neighbouring beams mostly hit one bin, whose hits are entered together: it held before_.
  mutable bool open_ = false;
  int open_bin_ = 0;
  SupportBin before_;
  mutable int updates_ = 0;
  mutable BinTally tally_;
  mutable std::vector<Stretch> stretches_;
};

}  // namespace cca
