// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace cca {

/// What the laser said about a few centimetres of a wall, in the wall's frame: t [m] along, d [m]
/// across. The sums are those of the returns, so that walls can be cut and joined exactly.
struct SupportBin {
  double hits = 0.0;    ///< returns that lie here; bounded, so that the newest can overrule the old
  double passed = 0.0;  ///< rays that went clearly through; bounded with the hits
  double t = 0.0, d = 0.0;              ///< sums over the hits
  double tt = 0.0, td = 0.0, dd = 0.0;  ///< m^2, sums over the hits
  double t_min = 0.0, t_max = 0.0;      ///< m, extreme hits

  void hit(double t_hit, double d_hit);
  void add(const SupportBin& other);
  void scale(double factor);
};

/// d = offset + slope * t.
struct LateralFit {
  double offset = 0.0;  ///< m
  double slope = 0.0;   ///< rad
  double at(double t) const { return offset + slope * t; }
};

/// Weighted sums of the bins' mean points: what a line fit, a joint fit and a cut are made from.
struct BinSums {
  double w = 0.0, t = 0.0, d = 0.0, tt = 0.0, td = 0.0, dd = 0.0;

  void add(const BinSums& other) {
    w += other.w;
    t += other.t;
    d += other.d;
    tt += other.tt;
    td += other.td;
    dd += other.dd;
  }
  void remove(const BinSums& other);
  void addPoint(double weight, double t_mean, double d_mean);
  /// Weighted sum of squared lateral residuals of the best line; 0 where fewer than two bins stand.
  double residual() const;
  /// The best line; zero where no bin stands, level where all lie in one place.
  LateralFit fit() const;
};

/// Half-open range of bins.
struct BinRange {
  int first = 0, last = 0;
};

/// The 1-D occupancy histogram along a wall.
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

  /// A return at (t, d); the profile grows to hold it.
  void hit(double t, double d);
  /// A ray went through at t; outside the profile this says nothing and costs nothing.
  void pass(double t, double rays = 1.0);
  /// Another profile's bin, already in this frame.
  void add(const SupportBin& bin);
  /// Empties a bin and returns what it held.
  SupportBin take(int i);
  /// Cuts [from, last()) off and returns it.
  SupportProfile cutFrom(int from);
  /// Forgets bins that rays have refuted, and empty ends. True where something went.
  bool prune();

  /// Hits minus refuted ones within +-kWindow bins decide whether a place is occupied.
  bool occupied(int i) const;
  /// Maximal occupied runs; gaps up to `max_gap` bins are closed where no ray went through them.
  void supportedRanges(int max_gap, std::vector<BinRange>& ranges) const;

  /// Of all bins; remembered until a hit changes.
  const BinSums& sums() const;
  BinSums sums(int from, int to) const;
  LateralFit fit() const { return sums().fit(); }
  /// The cut that lowers the residual sum of squares most.
  struct Cut {
    int at = 0;
    double gain = 0.0;  ///< m^2
  };
  Cut bestCut() const;

 private:
  void grow(int i);
  SupportBin& at(int i) { return bins_[static_cast<std::size_t>(i - first_)]; }
  int first_ = 0;
  std::vector<SupportBin> bins_;
  mutable BinSums sums_;
  mutable bool summed_ = false;  ///< sums_ holds
};

}  // namespace cca
