// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/support_profile.hpp"

#include <cmath>
#include <utility>

namespace cca {
namespace {

constexpr int kWindow = 2;           // bins on either side that speak for a place
constexpr double kFewestRays = 2.0;  // that refute a place, or part a wall: a single one may err
/// From which on a place is free. While a map grows, the rays that passed before the wall was
/// created are not counted; in hindsight all are, and the greater number decides.
constexpr double kRaysPerHit = 0.5, kRaysPerHitInHindsight = 1.0;

/// The mean point of a bin that holds hits, of its weight.
PointSums meanPoint(const SupportBin& bin) {
  const PointSums& s = bin.returns;
  const double share = 1.0 / (s.w + kHitsOfHalfWeight), per_hit = share / s.w;
  return {share * s.w,         share * s.x,         share * s.y,
          per_hit * s.x * s.x, per_hit * s.x * s.y, per_hit * s.y * s.y};
}

}  // namespace

void SupportBin::hit(double t, double d) {
  first = hits() > 0.0 ? std::min(first, t) : t;
  last = hits() > 0.0 ? std::max(last, t) : t;
  returns.addPoint(t, d);
  bound();
}

void SupportBin::add(const SupportBin& other) {
  if (other.hits() > 0.0) {
    first = hits() > 0.0 ? std::min(first, other.first) : other.first;
    last = hits() > 0.0 ? std::max(last, other.last) : other.last;
  }
  returns.add(other.returns);
  passed += other.passed;
  bound();
}

void SupportBin::bound() {
  if (hits() <= kMostHits) return;
  const double share = kMostHits / hits();
  returns.scale(share);
  passed *= share;
}

SupportBin SupportBin::part(double share, double t_first, double t_last) const {
  const PointSums& s = returns;
  const double t_mean = s.x / s.w, d_mean = s.y / s.w;
  const double var_t = s.xx / s.w - t_mean * t_mean, cov = s.xy / s.w - t_mean * d_mean,
               var_d = s.yy / s.w - d_mean * d_mean;
  const double slope = var_t > 1e-9 ? cov / var_t : 0.0;
  const double t = 0.5 * (t_first + t_last), d = d_mean + slope * (t - t_mean);
  const double spread = (t_last - t_first) * (t_last - t_first) / 12.0;
  const double across = std::max(0.0, var_d - slope * slope * (var_t - spread));
  const double n = share * s.w;
  const PointSums held{
      n, n * t, n * d, n * (t * t + spread), n * (t * d + slope * spread), n * (d * d + across)};
  SupportBin r;
  r.returns = held;
  r.passed = share * passed;
  r.first = t_first;
  r.last = t_last;
  return r;
}

void SupportProfile::grow(int i) {
  if (contains(i)) return;
  if (bins_.empty()) first_ = i;
  if (i < first_) {
    bins_.insert(bins_.begin(), static_cast<std::size_t>(first_ - i), SupportBin{});
    first_ = i;
  }
  if (i >= last()) bins_.resize(static_cast<std::size_t>(i - first_ + 1));
}

const SupportBin& SupportProfile::hit(double t, double d) {
  const int i = binOf(t);
  grow(i);
  added_up_ = false;
  at(i).hit(t, d);
  return bin(i);
}

bool SupportProfile::pass(double t, double rays) {
  const int i = binOf(t);
  if (!contains(i) || bin(i).passed >= SupportBin::kMostHits) return false;
  const double before = bin(i).passed;
  at(i).passed = std::min(before + rays, SupportBin::kMostHits);
  if (bin(i).isRefuted() || before < kFewestRays) return true;
  for (int k = std::max(first(), i - kWindow); k < std::min(last(), i + kWindow + 1); ++k) {
    if (bin(k).hits() <= 0.0) continue;
    const Counts now = countsAround(k);
    if (stand(now) != stand({now.hits, now.passed - bin(i).passed + before})) return true;
  }
  return false;
}

SupportProfile::Counts SupportProfile::countsAround(int i) const {
  Counts counts;
  for (int k = std::max(first(), i - kWindow); k < std::min(last(), i + kWindow + 1); ++k) {
    counts.hits += bin(k).hits();
    counts.passed += bin(k).passed;
  }
  return counts;
}

bool SupportProfile::stand(const Counts& counts) const {
  const double rays_per_hit = in_hindsight_ ? kRaysPerHitInHindsight : kRaysPerHit;
  return counts.passed < std::max(kFewestRays, rays_per_hit * counts.hits);
}

void SupportProfile::add(const SupportBin& other) {
  if (other.hits() <= 0.0) return;
  const int i = binOf(other.first), j = binOf(other.last);
  grow(i);
  grow(j);
  added_up_ = false;
  if (i == j) return at(i).add(other);
  // The hits straddle two bins: they are shared out as if they were spread evenly. A last hit on
  // the border may lie before it by a rounding error, and no bin may hold less than nothing.
  const double border = j * kBinLength;
  const double share = std::min((border - other.first) / (other.last - other.first), 1.0);
  at(i).add(other.part(share, other.first, border));
  if (share < 1.0) at(j).add(other.part(1.0 - share, border, other.last));
}

void SupportProfile::forget() {
  added_up_ = false;
  in_hindsight_ = true;
  bins_.assign(bins_.size(), SupportBin{});
}

SupportBin SupportProfile::take(int i) {
  added_up_ = false;
  return std::exchange(at(i), SupportBin{});
}

SupportProfile SupportProfile::cutFrom(int from) {
  added_up_ = false;
  SupportProfile tail;
  const auto begin = bins_.begin() + (from - first_);
  tail.in_hindsight_ = in_hindsight_;
  tail.first_ = from;
  tail.bins_.assign(begin, bins_.end());
  bins_.erase(begin, bins_.end());
  return tail;
}

std::vector<int> SupportProfile::prune() {
  std::vector<int> refuted;
  for (int i = first(); i < last(); ++i) {
    if (!bin(i).isRefuted()) continue;
    at(i) = {{}, bin(i).passed};
    refuted.push_back(i);
  }
  if (!refuted.empty()) added_up_ = false;
  const auto stands = [](const SupportBin& bin) { return bin.hits() > 0.0; };
  const auto end = std::find_if(bins_.rbegin(), bins_.rend(), stands).base();
  const auto begin = std::find_if(bins_.begin(), end, stands);
  first_ += static_cast<int>(begin - bins_.begin());
  bins_.erase(end, bins_.end());
  bins_.erase(bins_.begin(), begin);
  return refuted;
}

bool SupportProfile::occupied(int i) const { return bin(i).hits() > 0.0 && stand(countsAround(i)); }

std::vector<Stretch> SupportProfile::stretches() const {
  std::vector<Stretch> found;
  double passed_since = 0.0;
  for (int i = first(); i < last(); ++i) {
    if (!occupied(i)) {
      passed_since += bin(i).passed;
      continue;
    }
    const bool joins =
        !found.empty() && i - found.back().range.last <= kBridgedBins && passed_since < kFewestRays;
    if (!joins) found.push_back({{i, i}, {}});
    found.back().range.last = i + 1;
    passed_since = 0.0;
  }
  for (Stretch& s : found) {
    const bool whole = s.range.first == first() && s.range.last == last();
    s.tally = whole ? tally() : tally(s.range);
  }
  return found;
}

bool SupportProfile::spans(int i) const {
  if (!contains(i)) return false;
  const auto is_empty = [&](int k) { return contains(k) && bin(k).hits() <= 0.0; };
  int before = i, after = i;
  while (is_empty(before) && i - before < kBridgedBins) --before;
  while (is_empty(after) && after - before <= kBridgedBins) ++after;
  return contains(before) && contains(after) && !is_empty(before) && !is_empty(after);
}

const BinTally& SupportProfile::tally() const {
  if (!std::exchange(added_up_, true)) tally_ = tally({first(), last()});
  return tally_;
}

BinTally SupportProfile::tally(const BinRange& range) const {
  BinTally tally;
  for (int i = range.first; i < range.last; ++i) {
    if (bin(i).hits() <= 0.0) continue;
    tally.fitted.add(meanPoint(bin(i)));
    tally.returns.add(bin(i).returns);
  }
  return tally;
}

SupportProfile::Cut SupportProfile::bestCut() const {
  PointSums left, right = sums();
  const double whole = right.residual();
  Cut best{first(), 0.0};
  for (int i = first(); i + 1 < last(); ++i) {
    if (bin(i).hits() <= 0.0) continue;
    const PointSums one = meanPoint(bin(i));
    left.add(one);
    right.remove(one);
    const double gain = whole - left.residual() - right.residual();
    if (gain > best.gain) best = {i + 1, gain};
  }
  return best;
}

}  // namespace cca
