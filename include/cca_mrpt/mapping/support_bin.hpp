// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace cca {

/// What the laser said about a few centimetres of a wall, in the wall's frame: t [m] along, d [m]
/// across. The sums are those of the returns, so that walls can be cut and joined exactly.
struct SupportBin {
  double hits = 0.0;    ///< returns that lie here; bounded, so that the newest can overrule the old
  double passed = 0.0;  ///< rays that went clearly through; bounded with the hits
  double t = 0.0, d = 0.0;              ///< sums over the hits
  double tt = 0.0, td = 0.0, dd = 0.0;  ///< m^2, sums over the hits
  double t_min = 0.0, t_max = 0.0;      ///< m, extreme hits

  static constexpr double kMostHits = 200.0;  ///< more would only make the past heavier

  void hit(double t_hit, double d_hit) {
    t_min = hits > 0.0 ? std::min(t_min, t_hit) : t_hit;
    t_max = hits > 0.0 ? std::max(t_max, t_hit) : t_hit;
    hits += 1.0;
    t += t_hit;
    d += d_hit;
    tt += t_hit * t_hit;
    td += t_hit * d_hit;
    dd += d_hit * d_hit;
    if (hits > kMostHits) scale(kMostHits / hits);
  }
  void add(const SupportBin& other);
  void scale(double factor);
  /// A share of the hits, those between t_first and t_last, on the bin's own lateral line.
  SupportBin part(double share, double t_first, double t_last) const;
  /// So many rays went through that the hits are no wall, or none any more.
  bool isRefuted() const { return hits > 0.0 && passed > 4.0 && passed > 2.0 * hits; }
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
  void remove(const BinSums& other) {
    add({-other.w, -other.t, -other.d, -other.tt, -other.td, -other.dd});
  }
  void addPoint(double weight, double t_mean, double d_mean);
  /// The mean point of a bin that holds hits, with a weight below 1, so that one place does not
  /// outvote the others, that grows with the hits, so that one glance does not bend a wall.
  void addMeanPoint(const SupportBin& bin) {
    constexpr double kHitsOfHalfWeight = 2.0;
    const double share = 1.0 / (bin.hits + kHitsOfHalfWeight), per_hit = share / bin.hits;
    add({share * bin.hits, share * bin.t, share * bin.d, per_hit * bin.t * bin.t,
         per_hit * bin.t * bin.d, per_hit * bin.d * bin.d});
  }
  /// Weighted sum of squared lateral residuals of the best line; 0 where fewer than two bins stand.
  double residual() const;
  /// The best line; zero where no bin stands, level where all lie in one place.
  LateralFit fit() const;
};

/// Half-open range of bins.
struct BinRange {
  int first = 0, last = 0;
};

/// What is added up over bins.
struct BinTally {
  BinSums fitted;   ///< of the bins' mean points, each with a bounded weight
  BinSums returns;  ///< of the returns themselves; w is their number

  void add(const SupportBin& bin) {
    if (bin.hits <= 0.0) return;
    fitted.addMeanPoint(bin);
    returns.add({bin.hits, bin.t, bin.d, bin.tt, bin.td, bin.dd});
  }
  void add(const BinTally& other) {
    fitted.add(other.fitted);
    returns.add(other.returns);
  }
  void remove(const BinTally& other) {
    fitted.remove(other.fitted);
    returns.remove(other.returns);
  }
};

}  // namespace cca
