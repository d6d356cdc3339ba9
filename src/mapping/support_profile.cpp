// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/support_profile.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cca {
namespace {

constexpr double kMostHits = 200.0;        // per bin; more only makes the past heavier
constexpr int kWindow = 2;                 // bins on either side that speak for a place
constexpr double kHitsOfHalfWeight = 2.0;  // so that one glance does not bend a wall
constexpr double kFewestRays = 2.0;        // that can refute a place
constexpr double kRaysPerHit = 0.5;        // from which on a place is free

double binWeight(const SupportBin& bin) { return bin.hits / (bin.hits + kHitsOfHalfWeight); }

/// A share of the bin's hits, those between t_min and t_max, on the bin's own lateral line.
SupportBin part(const SupportBin& bin, double share, double t_min, double t_max) {
  const double n = bin.hits, t = bin.t / n, d = bin.d / n;
  const double var_t = bin.tt / n - t * t, cov = bin.td / n - t * d, var_d = bin.dd / n - d * d;
  const double slope = var_t > 1e-9 ? cov / var_t : 0.0;
  const double t_part = 0.5 * (t_min + t_max), d_part = d + slope * (t_part - t);
  const double spread = (t_max - t_min) * (t_max - t_min) / 12.0;
  SupportBin r;
  r.hits = share * n;
  r.passed = share * bin.passed;
  r.t = r.hits * t_part;
  r.d = r.hits * d_part;
  r.tt = r.hits * (t_part * t_part + spread);
  r.td = r.hits * (t_part * d_part + slope * spread);
  r.dd = r.hits * (d_part * d_part + std::max(0.0, var_d - slope * slope * (var_t - spread)));
  r.t_min = t_min;
  r.t_max = t_max;
  return r;
}

}  // namespace

void SupportBin::hit(double t_hit, double d_hit) {
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

void SupportBin::add(const SupportBin& other) {
  if (other.hits > 0.0) {
    t_min = hits > 0.0 ? std::min(t_min, other.t_min) : other.t_min;
    t_max = hits > 0.0 ? std::max(t_max, other.t_max) : other.t_max;
  }
  hits += other.hits;
  passed += other.passed;
  t += other.t;
  d += other.d;
  tt += other.tt;
  td += other.td;
  dd += other.dd;
  if (hits > kMostHits) scale(kMostHits / hits);
}

void SupportBin::scale(double factor) {
  for (double* sum : {&hits, &passed, &t, &d, &tt, &td, &dd}) *sum *= factor;
}

void BinSums::remove(const BinSums& o) {
  w -= o.w;
  t -= o.t;
  d -= o.d;
  tt -= o.tt;
  td -= o.td;
  dd -= o.dd;
}

void BinSums::addPoint(double weight, double t_mean, double d_mean) {
  add({weight, weight * t_mean, weight * d_mean, weight * t_mean * t_mean, weight * t_mean * d_mean,
       weight * d_mean * d_mean});
}

double BinSums::residual() const {
  if (w <= 0.0) return 0.0;
  const double var_t = tt - t * t / w, cov = td - t * d / w, var_d = dd - d * d / w;
  if (var_t <= 1e-9) return std::max(0.0, var_d);
  return std::max(0.0, var_d - cov * cov / var_t);
}

LateralFit BinSums::fit() const {
  if (w <= 0.0) return {};
  const double var_t = tt - t * t / w, cov = td - t * d / w;
  const double slope = var_t > 1e-9 ? cov / var_t : 0.0;
  return {(d - slope * t) / w, slope};
}

void SupportProfile::grow(int i) {
  if (bins_.empty()) first_ = i;
  if (i < first_) {
    bins_.insert(bins_.begin(), static_cast<std::size_t>(first_ - i), SupportBin{});
    first_ = i;
  }
  if (i >= last()) bins_.resize(static_cast<std::size_t>(i - first_ + 1));
}

void SupportProfile::hit(double t, double d) {
  const int i = binOf(t);
  grow(i);
  at(i).hit(t, d);
  summed_ = false;
}

void SupportProfile::pass(double t, double rays) {
  const int i = binOf(t);
  if (contains(i)) at(i).passed = std::min(at(i).passed + rays, kMostHits);
}

void SupportProfile::add(const SupportBin& other) {
  if (other.hits <= 0.0) return;
  const int i = binOf(other.t_min), j = binOf(other.t_max);
  grow(i);
  grow(j);
  summed_ = false;
  if (i == j) return at(i).add(other);
  // The hits straddle two bins: they are shared out as if they were spread evenly.
  const double border = j * kBinLength;
  const double share = (border - other.t_min) / (other.t_max - other.t_min);
  at(i).add(part(other, share, other.t_min, border));
  at(j).add(part(other, 1.0 - share, border, other.t_max));
}

SupportBin SupportProfile::take(int i) {
  summed_ = false;
  return std::exchange(at(i), SupportBin{});
}

SupportProfile SupportProfile::cutFrom(int from) {
  summed_ = false;
  SupportProfile tail;
  const auto begin = bins_.begin() + (from - first_);
  tail.first_ = from;
  tail.bins_.assign(begin, bins_.end());
  bins_.erase(begin, bins_.end());
  return tail;
}

bool SupportProfile::prune() {
  for (SupportBin& bin : bins_) {
    if (bin.hits > 0.0 && bin.passed > 4.0 && bin.passed > 2.0 * bin.hits) {
      const double passed = bin.passed;
      bin = SupportBin{};
      bin.passed = passed;
      summed_ = false;
    }
  }
  const auto stands = [](const SupportBin& bin) { return bin.hits > 0.0; };
  const auto begin = std::find_if(bins_.begin(), bins_.end(), stands);
  const auto end = std::find_if(bins_.rbegin(), bins_.rend(), stands).base();
  const bool changed = begin != bins_.begin() || end != bins_.end();
  if (begin == bins_.end()) {
    bins_.clear();
    return changed;
  }
  first_ += static_cast<int>(begin - bins_.begin());
  bins_.erase(end, bins_.end());
  bins_.erase(bins_.begin(), begin);
  return changed;
}

bool SupportProfile::occupied(int i) const {
  if (bin(i).hits <= 0.0) return false;
  const SupportBin* from = bins_.data() + (std::max(first(), i - kWindow) - first_);
  const SupportBin* to = bins_.data() + (std::min(last(), i + kWindow + 1) - first_);
  double hits = 0.0, passed = 0.0;
  for (const SupportBin* b = from; b < to; ++b) passed += b->passed;
  if (passed < kFewestRays) return true;
  for (const SupportBin* b = from; b < to; ++b) hits += b->hits;
  return passed < kRaysPerHit * hits;
}

void SupportProfile::supportedRanges(int max_gap, std::vector<BinRange>& ranges) const {
  ranges.clear();
  double passed_since = 0.0;
  int rays = first() - kWindow - 1;  // the last bin up to i + kWindow that any ray went through
  for (int i = first() - kWindow; i < last(); ++i) {
    if (i + kWindow < last() && bin(i + kWindow).passed > 0.0) rays = i + kWindow;
    if (i < first()) continue;
    const bool stands = rays < i - kWindow ? bin(i).hits > 0.0 : occupied(i);
    if (!stands) {
      passed_since += bin(i).passed;
      continue;
    }
    const bool joins = !ranges.empty() && i - ranges.back().last <= max_gap && passed_since < 2.0;
    if (joins) {
      ranges.back().last = i + 1;
    } else {
      ranges.push_back({i, i + 1});
    }
    passed_since = 0.0;
  }
}

const BinSums& SupportProfile::sums() const {
  if (!summed_) sums_ = sums(first(), last());
  summed_ = true;
  return sums_;
}

BinSums SupportProfile::sums(int from, int to) const {
  BinSums sum;
  for (int i = from; i < to; ++i) {
    const SupportBin& b = bin(i);
    if (b.hits > 0.0) sum.addPoint(binWeight(b), b.t / b.hits, b.d / b.hits);
  }
  return sum;
}

SupportProfile::Cut SupportProfile::bestCut() const {
  BinSums left, right = sums();
  const double whole = right.residual();
  Cut best{first(), 0.0};
  for (int i = first(); i + 1 < last(); ++i) {
    const SupportBin& b = bin(i);
    if (b.hits <= 0.0) continue;
    BinSums one;
    one.addPoint(binWeight(b), b.t / b.hits, b.d / b.hits);
    left.add(one);
    right.remove(one);
    const double gain = whole - left.residual() - right.residual();
    if (gain > best.gain) best = {i + 1, gain};
  }
  return best;
}

}  // namespace cca
