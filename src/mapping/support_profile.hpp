// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "cca_mrpt/geometry/point_sums.hpp"

namespace cca {

/// What the laser said about a few centimetres of a wall, in the wall's frame: x [m] along, y [m]
/// across.
struct SupportBin {
  PointSums returns;    ///< those that lie here; bounded, so that the newest can overrule the old
  double passed = 0.0;  ///< rays that went clearly through; bounded with the hits
  double first = 0.0, last = 0.0;  ///< m along, extreme hits

  static constexpr double kMostHits = 200.0;  ///< more would only make the past heavier

  double hits() const { return returns.w; }
  /// m, of at least one hit.
  Eigen::Vector2d mean() const { return {returns.x / returns.w, returns.y / returns.w}; }
  void hit(double t, double d);
  void add(const SupportBin& other);
  /// A share of the hits, those between t_first and t_last, on the bin's own lateral line.
  SupportBin part(double share, double t_first, double t_last) const;
  /// So many rays went through that the hits are no wall, or none any more.
  bool isRefuted() const { return hits() > 0.0 && passed > 4.0 && passed > 2.0 * hits(); }

 private:
  void bound();
};

/// What the mean point of a bin that holds hits weighs in a fit: below 1, so that one place does
/// not outvote the others, and more with the hits, so that one glance does not bend a wall.
inline constexpr double kHitsOfHalfWeight = 2.0;
inline double weightOf(const SupportBin& bin) {
  return bin.hits() / (bin.hits() + kHitsOfHalfWeight);
}

/// Half-open range of bins.
struct BinRange {
  int first = 0, last = 0;
};

/// What is added up over bins.
struct BinTally {
  PointSums fitted;   ///< of the bins' mean points, each with a bounded weight
  PointSums returns;  ///< of the returns themselves; w is their number
};

/// A maximal occupied run of bins.
struct Stretch {
  BinRange range;
  BinTally tally;
};

/// The 1-D occupancy histogram along a wall.
class SupportProfile {
 public:
  /// m; a jamb of 0.1 m has two, and ends are right to half a bin.
  static constexpr double kBinLength = 0.05;
  /// m; what is nearer is not told apart: ends of a corner, a new wall, what lies behind one.
  static constexpr double kResolved = 2.0 * kBinLength;
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
  /// Empties all bins, to be filled from all scans in hindsight; where they are stays.
  void forget();
  /// Empties a bin and returns what it held.
  SupportBin take(int i);
  /// Cuts [from, last()) off and returns it.
  SupportProfile cutFrom(int from);
  /// Forgets bins that rays have refuted, and empty ends. @return  the refuted ones.
  std::vector<int> prune();

  /// Hits minus refuted ones within +-kWindow bins decide whether a place is occupied.
  bool occupied(int i) const;
  /// Maximal occupied runs; gaps up to kBridgedBins are closed where no ray went through them.
  static constexpr int kBridgedBins = 4;  // longer gaps without hits would be phantoms
  std::vector<Stretch> stretches() const;
  /// Whether bin i holds hits, or lies in a gap between hits of kBridgedBins at most.
  bool spans(int i) const;

  BinTally tally(const BinRange& range) const;
  /// Of all bins, remembered until the next hit.
  const BinTally& tally() const;
  const PointSums& sums() const { return tally().fitted; }
  LateralFit fit() const { return sums().fit(); }
  /// The cut that lowers the residual sum of squares most.
  struct Cut {
    int at = 0;
    double gain = 0.0;  ///< m^2
  };
  Cut bestCut() const;

 private:
  void grow(int i);
  /// What decides whether a place is occupied.
  struct Counts {
    double hits = 0.0, passed = 0.0;
  };
  bool stand(const Counts& counts) const;
  Counts countsAround(int i) const;
  SupportBin& at(int i) { return bins_[static_cast<std::size_t>(i - first_)]; }

  int first_ = 0;
  std::vector<SupportBin> bins_;
  bool in_hindsight_ = false;      ///< its returns and rays are those of all scans
  mutable bool added_up_ = false;  ///< tally_ holds
  mutable BinTally tally_;
};

}  // namespace cca
